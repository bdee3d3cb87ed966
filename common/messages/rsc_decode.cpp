#include <bit>

#include "common/messages/map.hpp"
#include "common/messages/rsc.hpp"
#include "common/messages/rsc_fields.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using namespace rsc;
using wire::fixed64_key;
using wire::kAbsent;
using wire::message_key;
using wire::varint_key;

constexpr std::int64_t kLifetimeUnavailable = 65'535;
constexpr std::int64_t kBehaviorMax = (1 << 14) - 1;
constexpr std::int64_t kEstimatedTimeMax = 65'535;
constexpr std::int64_t kNodeMax = 65'535;
constexpr std::int64_t kLaneBitsMax = (1 << 16) - 1;

/// A point of a path as it came.
struct RawPoint {
  wire::RawPosition position;
  std::int64_t speed = kAbsent;
  std::int64_t acceleration = kAbsent;
  std::int64_t estimated_time = kAbsent;
};

struct RawVehicle {
  std::uint64_t id = 0;
  bool has_id = false;
  bool broken = false;
  bool has_suggestion = false;
  std::int64_t behavior = kAbsent;
  std::int64_t lifetime = kAbsent;
  std::size_t points = 0;
  RawPoint first;
  std::vector<RawPoint> later;
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
  if (++raw.points > kMaxPathPoints) return;  // too many to be taken
  RawPoint& point = raw.points == 1 ? raw.first : raw.later.emplace_back();
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case message_key(1):
        wire::read_position(reader.message(), point.position);
        break;
      case varint_key(2):
        point.speed = reader.value();
        break;
      case message_key(4):
        point.acceleration = wire::read_acceleration(reader.message());
        break;
      case varint_key(5):
        point.estimated_time = reader.value();
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

/// The checked point's place; empty if that is nowhere, which `check` then says.
PlanePoint centre_of(const RawPoint& point, const wire::RawPosition& reference, wire::Check& check) {
  const auto centre = wire::point_at(reference, point.position);
  check.that("the reference position", centre.has_value());
  return centre.value_or(PlanePoint{});
}

/// Adds the further points of a path to it.
void take_later(const RawVehicle& raw, const wire::RawPosition& reference, GuidedPath& path, wire::Check& check) {
  std::int64_t before = 0;
  check.optional("path.estimated_time_10ms of the first point", raw.first.estimated_time, 0, 0);
  for (const RawPoint& point : raw.later) {
    wire::check_offset(check, "path.position", point.position);
    check.required("path.acceleration.longitudinal_cmps2", point.acceleration, -wire::kAccelerationMax,
                   wire::kAccelerationMax);
    check.required("path.estimated_time_10ms", point.estimated_time, before + 1, raw.lifetime - 1);
    if (!check.ok()) return;
    before = point.estimated_time;
    path.later.push_back({.from_ms = static_cast<std::uint32_t>(point.estimated_time) * kLifetimeUnit_ms,
                          .acceleration_mps2 = static_cast<double>(point.acceleration) / 100.0,
                          .centre = centre_of(point, reference, check)});
  }
}

void take_path(const RawVehicle& raw, const wire::RawPosition& reference, GuidedPath& path, wire::Check& check) {
  const RawPoint& first = raw.first;
  const bool speed_alone = raw.points == 1 && first.acceleration == kAbsent && first.speed != kAbsent;
  wire::check_offset(check, "path.position", first.position);
  check.required("suggestion.lifetime_10ms", raw.lifetime, 1, kLifetimeMax);
  if (speed_alone) {
    check.required("path.speed_2cmps", first.speed, 0, wire::kSpeedMax);
  } else {
    check.required("path.acceleration.longitudinal_cmps2", first.acceleration, -wire::kAccelerationMax,
                   wire::kAccelerationMax);
    check.optional("path.speed_2cmps", first.speed, 0, wire::kSpeedUnavailable);
  }
  check.optional("path.estimated_time_10ms", first.estimated_time, 0, kEstimatedTimeMax);
  if (!check.ok()) return;
  path.centre = centre_of(first, reference, check);
  path.acceleration_mps2 = speed_alone ? 0.0 : static_cast<double>(first.acceleration) / 100.0;
  path.lifetime_ms = static_cast<std::uint32_t>(raw.lifetime) * kLifetimeUnit_ms;
  if (speed_alone) path.speed_mps = wire::speed_mps(first.speed);
  if (!raw.later.empty()) take_later(raw, reference, path, check);
}

/// Adds the car to the message, or says in `check` what is wrong with it.
void take_vehicle(const RawVehicle& raw, const wire::RawPosition& reference, Coordination& message,
                  wire::Check& check) {
  check.that("the encoding of a vehicle", !raw.broken);
  check.that("vehicle_id", raw.has_id);
  check.that("the number of path points", raw.points <= kMaxPathPoints);
  check.required("binding", raw.binding, 0, 1);
  if (raw.has_suggestion) check.required("suggestion.behavior_bits", raw.behavior, 0, kBehaviorMax);
  check.optional("suggestion.lifetime_10ms", raw.lifetime, 1, kLifetimeUnavailable);
  if (!check.ok()) return;
  VehicleCoordination& vehicle = message.vehicles.emplace_back();
  vehicle.vehicle = raw.id;
  vehicle.binding = static_cast<Binding>(raw.binding);
  if (raw.points > 0) take_path(raw, reference, vehicle.path.emplace(), check);
}

/// The same for a lane. The nodes and lanes are those of our MAP.
void take_lane(std::span<const std::uint8_t> bytes, Coordination& message, wire::Check& check) {
  std::int64_t upstream = kAbsent;
  std::int64_t node = kAbsent;
  std::int64_t lanes = kAbsent;
  std::int64_t speed = kAbsent;
  std::int64_t lifetime = kAbsent;
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case message_key(1): {
        wire::Reader link(reader.message());
        while (link.next()) {
          if (link.field() == varint_key(1)) upstream = link.value();
          if (link.field() == varint_key(2)) node = link.value();
          if (link.field() == varint_key(3)) lanes = link.value();
        }
        check.that("the encoding of a lane", !link.broken());
        break;
      }
      case varint_key(2):
        speed = reader.value();
        break;
      case varint_key(kLaneLifetimeField):
        lifetime = reader.value();
        break;
      default:
        break;
    }
  }
  check.that("the encoding of a lane", !reader.broken());
  check.required("target_lane.upstream_node_id", upstream, kFirstNeighbour, kFirstNeighbour + kApproaches - 1);
  check.required("target_lane.downstream_node_id", node, 0, kNodeMax);
  check.required("target_lane.lane_bits", lanes, 0, kLaneBitsMax);
  check.required("lane's speed_2cmps", speed, 0, wire::kSpeedMax);
  check.required("lane's lifetime_10ms", lifetime, 1, kLifetimeMax);
  if (!check.ok()) return;
  const auto bits = static_cast<std::uint32_t>(lanes);
  check.that("target_lane.lane_bits", std::has_single_bit(bits) && bits >= 2 && bits < 2U << kLanesPerApproach);
  if (!check.ok()) return;
  const auto turn = static_cast<Turn>(std::countr_zero(bits) - 1);
  message.node = static_cast<std::uint16_t>(node);
  message.lanes.push_back({.lane = lane_of(static_cast<Approach>(upstream - kFirstNeighbour), turn),
                           .speed_mps = static_cast<double>(speed) / wire::kSpeedUnitsPerMps,
                           .lifetime_ms = static_cast<std::uint32_t>(lifetime) * kLifetimeUnit_ms});
}

}  // namespace

Expected<Coordination> decode_rsc(std::span<const std::uint8_t> payload) {
  // The cars follow in a second walk: their paths are told from the reference, which may stand behind them.
  std::int64_t count = kAbsent;
  std::int64_t second_mark_ms = kAbsent;
  bool has_id = false;
  wire::RawPosition reference;
  std::size_t vehicles = 0;
  std::size_t lanes = 0;
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
      case message_key(6):
        ++lanes;
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
  check.that("the number of lanes", lanes <= kMaxLaneCoordinations);
  if (!check.ok()) return check.error("RSC");
  message.count = static_cast<std::uint8_t>(count);
  message.second_mark_ms = static_cast<std::uint16_t>(second_mark_ms);
  message.vehicles.reserve(vehicles);
  wire::Reader again(payload);
  while (again.next() && check.ok()) {
    if (again.field() == message_key(5)) take_vehicle(read_vehicle(again.message()), reference, message, check);
    if (again.field() == message_key(6)) take_lane(again.message(), message, check);
  }
  if (!check.ok()) return check.error("RSC");
  return message;
}

}  // namespace lukou
