#include "common/messages/rsc.hpp"

#include "common/core/contract.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using wire::fixed64_key;
using wire::kAbsent;
using wire::message_key;
using wire::varint_key;

constexpr std::uint32_t kBindingField = 100;
constexpr std::uint32_t kLifetimeUnit_ms = 10;
constexpr std::int64_t kLifetimeMax = 65'534;
constexpr std::int64_t kLifetimeUnavailable = 65'535;
constexpr std::uint64_t kSlowDown = 1U << 11U;
constexpr std::uint64_t kSpeedUp = 1U << 12U;
constexpr std::int64_t kBehaviorMax = (1 << 14) - 1;

// UPER in bytes, as counted for the standard's message: its head, each suggestion, each point with acceleration.
constexpr std::uint32_t kHeadBytes = 24;
constexpr std::uint32_t kSuggestionBytes = 14;
constexpr std::uint32_t kPointBytes = 17;

std::int64_t acceleration_units(double acceleration_mps2) {
  return wire::to_units(acceleration_mps2, 100.0, -wire::kAccelerationMax, wire::kAccelerationMax, 0);
}

void write_vehicle(wire::Writer& writer, const VehicleCoordination& vehicle) {
  const std::size_t begin = writer.open(5);
  writer.fixed64_field(1, vehicle.vehicle);
  if (vehicle.path) {
    const std::int64_t acceleration = acceleration_units(vehicle.path->acceleration_mps2);
    const std::size_t suggestion = writer.open(2);
    writer.unsigned_field(1, acceleration > 0 ? kSpeedUp : (acceleration < 0 ? kSlowDown : 0));
    writer.unsigned_field(2, vehicle.path->lifetime_ms / kLifetimeUnit_ms);
    writer.close(suggestion);
    const std::size_t path = writer.open(3);
    const std::size_t point = writer.open(1);
    wire::write_offset(writer, 1, vehicle.path->centre);
    wire::write_acceleration(writer, 4, acceleration);
    writer.unsigned_field(5, 0);
    writer.close(point);
    writer.close(path);
  }
  if (vehicle.binding != Binding::kGuard) {
    writer.unsigned_field(kBindingField, static_cast<std::uint64_t>(vehicle.binding));
  }
  writer.close(begin);
}

struct RawVehicle {
  std::uint64_t id = 0;
  bool has_id = false;
  bool broken = false;
  bool has_suggestion = false;
  std::int64_t behavior = kAbsent;
  std::int64_t lifetime = kAbsent;
  std::size_t points = 0;
  wire::RawPosition position;
  std::int64_t acceleration = kAbsent;
  std::int64_t estimated_time = kAbsent;
  std::int64_t binding = 0;
};

void read_suggestion(std::span<const std::uint8_t> bytes, RawVehicle& raw) {
  raw.has_suggestion = true;
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) raw.behavior = reader.value();
    if (reader.field() == varint_key(2)) raw.lifetime = reader.value();
  }
  raw.broken = raw.broken || reader.broken();
}

void read_point(std::span<const std::uint8_t> bytes, RawVehicle& raw) {
  ++raw.points;
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case message_key(1):
        wire::read_position(reader.message(), raw.position);
        break;
      case message_key(4):
        raw.acceleration = wire::read_acceleration(reader.message());
        break;
      case varint_key(5):
        raw.estimated_time = reader.value();
        break;
      default:
        break;
    }
  }
  raw.broken = raw.broken || reader.broken();
}

RawVehicle read_vehicle(std::span<const std::uint8_t> bytes) {
  RawVehicle raw;
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case fixed64_key(1):
        raw.id = reader.bits(), raw.has_id = true;
        break;
      case message_key(2):
        read_suggestion(reader.message(), raw);
        break;
      case message_key(3): {
        wire::Reader path(reader.message());
        while (path.next()) {
          if (path.field() == message_key(1)) read_point(path.message(), raw);
        }
        raw.broken = raw.broken || path.broken();
        break;
      }
      case varint_key(kBindingField):
        raw.binding = reader.value();
        break;
      default:
        break;
    }
  }
  raw.broken = raw.broken || reader.broken();
  return raw;
}

/// Adds the car to the message, or says in `check` what is wrong with it.
void take_vehicle(const RawVehicle& raw, const wire::RawPosition& reference, Coordination& message,
                  wire::Check& check) {
  check.that("the encoding of a vehicle", !raw.broken);
  check.that("vehicle_id", raw.has_id);
  check.that("the number of path points", raw.points <= 1);
  check.required("binding", raw.binding, 0, 1);
  if (raw.has_suggestion) check.required("suggestion.behavior_bits", raw.behavior, 0, kBehaviorMax);
  check.optional("suggestion.lifetime_10ms", raw.lifetime, 1, kLifetimeUnavailable);
  VehicleCoordination vehicle{.vehicle = raw.id, .path = {}, .binding = Binding::kGuard};
  if (raw.points > 0) {
    wire::check_offset(check, "path.position", raw.position);
    check.required("suggestion.lifetime_10ms", raw.lifetime, 1, kLifetimeMax);
    check.required("path.acceleration.longitudinal_cmps2", raw.acceleration, -wire::kAccelerationMax,
                   wire::kAccelerationMax);
    check.optional("path.estimated_time_10ms", raw.estimated_time, 0, 65'535);
    if (!check.ok()) return;
    const auto centre = wire::point_at(reference, raw.position);
    check.that("the reference position", centre.has_value());
    if (!check.ok()) return;
    vehicle.path = GuidedPath{.centre = *centre,
                              .acceleration_mps2 = static_cast<double>(raw.acceleration) / 100.0,
                              .lifetime_ms = static_cast<std::uint32_t>(raw.lifetime) * kLifetimeUnit_ms};
  }
  if (!check.ok()) return;
  vehicle.binding = static_cast<Binding>(raw.binding);
  message.vehicles.push_back(vehicle);
}

}  // namespace

bool fits(const GuidedPath& path) {
  return path.acceleration_mps2 >= -20.0 && path.acceleration_mps2 <= 20.0 && path.lifetime_ms >= kLifetimeUnit_ms &&
         path.lifetime_ms <= kLifetimeMax * kLifetimeUnit_ms && path.lifetime_ms % kLifetimeUnit_ms == 0;
}

void append(Frames& frames, const Envelope& envelope, const Coordination& message) {
  LUKOU_EXPECT(message.count <= wire::kCountMax && message.second_mark_ms <= wire::kSecondMarkMax);
  LUKOU_EXPECT(message.vehicles.size() <= kMaxCoordinations);
  wire::Writer writer(frames.payload);
  writer.unsigned_field(1, message.count);
  writer.fixed64_field(2, message.rsu);
  writer.unsigned_field(3, message.second_mark_ms);
  wire::write_position(writer, 4, kGeoReference.latitude_e7, kGeoReference.longitude_e7);
  std::uint32_t wire_bytes = kHeadBytes;
  for (const VehicleCoordination& vehicle : message.vehicles) {
    LUKOU_EXPECT(!vehicle.path || fits(*vehicle.path));
    write_vehicle(writer, vehicle);
    wire_bytes += kSuggestionBytes + (vehicle.path ? kPointBytes : 0);
  }
  wire::finish_frame(frames, envelope, FrameKind::kRsc, wire_bytes);
}

Expected<Coordination> decode_rsc(std::span<const std::uint8_t> payload) {
  // The cars follow in a second walk: their paths are told from the reference, which may stand behind them.
  std::int64_t count = kAbsent;
  std::int64_t second_mark_ms = kAbsent;
  bool has_id = false;
  wire::RawPosition reference;
  std::size_t vehicles = 0;
  Coordination message;
  wire::Reader reader(payload);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        count = reader.value();
        break;
      case fixed64_key(2):
        message.rsu = reader.bits(), has_id = true;
        break;
      case varint_key(3):
        second_mark_ms = reader.value();
        break;
      case message_key(4):
        wire::read_position(reader.message(), reference);
        break;
      case message_key(5):
        ++vehicles;
        break;
      default:
        break;
    }
  }
  wire::Check check;
  check.that("the encoding", !reader.broken());
  check.required("msg_count", count, 0, wire::kCountMax);
  check.that("id", has_id);
  check.required("second_mark_ms", second_mark_ms, 0, wire::kSecondMarkMax);
  wire::check_position(check, "reference", reference);
  check.that("the number of vehicles", vehicles <= kMaxCoordinations);
  if (!check.ok()) return check.error("RSC");
  message.count = static_cast<std::uint8_t>(count);
  message.second_mark_ms = static_cast<std::uint16_t>(second_mark_ms);
  message.vehicles.reserve(vehicles);
  wire::Reader again(payload);
  while (again.next() && check.ok()) {
    if (again.field() == message_key(5)) take_vehicle(read_vehicle(again.message()), reference, message, check);
  }
  if (!check.ok()) return check.error("RSC");
  return message;
}

}  // namespace lukou
