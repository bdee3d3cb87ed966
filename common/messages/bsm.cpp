#include "common/messages/bsm.hpp"

#include "common/core/contract.hpp"
#include "common/core/math.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using wire::kAbsent;
using wire::message_key;
using wire::to_units;
using wire::varint_key;

constexpr std::int64_t kAccelerationUnavailable = 2001;
constexpr std::int64_t kForwardGears = 2;
constexpr std::int64_t kPedalOff = 1;
constexpr std::int64_t kPedalOn = 2;

// UPER of the message of a unit that is equipped as usual, in bits: frame 4; presence 8; count 7; id 64; second 16;
// position with elevation 80; confidence of time 6 and position 5; gear 3; speed 13; heading 15; accelerations 48;
// all states of the brakes 24; size 23; class 10. Together 326 bits. Accuracy, where there is one: 32.
constexpr std::uint32_t kWireBits = 326;
constexpr std::uint32_t kAccuracyBits = 32;

constexpr double kAccuracyUnitsPerM = 20.0;
constexpr std::int64_t kAccuracyMax = 254;
constexpr std::int64_t kAccuracyUnavailable = 255;
constexpr std::int64_t kOrientationUnavailable = 65'535;

struct Raw {
  std::int64_t count = kAbsent;
  std::uint64_t id = 0;
  bool has_id = false;
  bool broken = false;
  std::int64_t second_mark_ms = kAbsent;
  wire::RawPosition position;
  std::int64_t transmission = kAbsent;
  std::int64_t speed = kAbsent;
  std::int64_t heading = kAbsent;
  std::int64_t acceleration = kAbsent;
  std::int64_t pedal = kAbsent;
  bool has_brakes = false;
  wire::RawSize size;
  std::int64_t vehicle_class = kAbsent;
  std::int64_t semi_major = kAbsent;
  std::int64_t semi_minor = kAbsent;
  std::int64_t orientation = kAbsent;
  bool has_accuracy = false;
};

void read_brakes(std::span<const std::uint8_t> bytes, Raw& raw) {
  raw.has_brakes = true;
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) raw.pedal = reader.value();
  }
  raw.broken = raw.broken || reader.broken();
}

void read_accuracy(std::span<const std::uint8_t> bytes, Raw& raw) {
  raw.has_accuracy = true;
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) raw.semi_major = reader.value();
    if (reader.field() == varint_key(2)) raw.semi_minor = reader.value();
    if (reader.field() == varint_key(3)) raw.orientation = reader.value();
  }
  raw.broken = raw.broken || reader.broken();
}

/// A message as append() writes it without an accuracy; false: it is another one.
bool read_as_written(std::span<const std::uint8_t> payload, Raw& raw) {
  wire::InOrder in(payload);
  raw.has_id = raw.has_brakes = true;
  return in.unsigned_field(1, raw.count) && in.fixed64_field(2, raw.id) && in.unsigned_field(3, raw.second_mark_ms) &&
         in.open(4) && in.signed_field(1, raw.position.latitude_e7) && in.signed_field(2, raw.position.longitude_e7) &&
         in.close() && in.unsigned_field(5, raw.transmission) && in.unsigned_field(6, raw.speed) &&
         in.unsigned_field(7, raw.heading) && in.open(8) && in.signed_field(1, raw.acceleration) && in.close() &&
         in.open(9) && in.unsigned_field(1, raw.pedal) && in.close() && in.open(10) &&
         in.unsigned_field(1, raw.size.width_cm) && in.unsigned_field(2, raw.size.length_cm) && in.close() &&
         in.unsigned_field(11, raw.vehicle_class) && in.at_end();
}

Raw read(std::span<const std::uint8_t> payload) {
  if (Raw quick; read_as_written(payload, quick)) return quick;
  Raw raw;
  wire::Reader reader(payload);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        raw.count = reader.value();
        break;
      case wire::fixed64_key(2):
        raw.id = reader.bits(), raw.has_id = true;
        break;
      case varint_key(3):
        raw.second_mark_ms = reader.value();
        break;
      case message_key(4):
        wire::read_position(reader.message(), raw.position);
        break;
      case varint_key(5):
        raw.transmission = reader.value();
        break;
      case varint_key(6):
        raw.speed = reader.value();
        break;
      case varint_key(7):
        raw.heading = reader.value();
        break;
      case message_key(8):
        raw.acceleration = wire::read_acceleration(reader.message());
        break;
      case message_key(9):
        read_brakes(reader.message(), raw);
        break;
      case message_key(10):
        wire::read_size(reader.message(), raw.size);
        break;
      case varint_key(11):
        raw.vehicle_class = reader.value();
        break;
      case message_key(12):
        read_accuracy(reader.message(), raw);
        break;
      default:
        break;  // a later edition's field
    }
  }
  raw.broken = raw.broken || reader.broken();
  return raw;
}

}  // namespace

void append(Frames& frames, const Envelope& envelope, const BasicSafety& message) {
  LUKOU_EXPECT(message.count <= wire::kCountMax && message.second_mark_ms <= wire::kSecondMarkMax);
  const GeoPoint position = to_geo(message.centre);
  const std::int64_t acceleration = message.acceleration_mps2
                                        ? to_units(*message.acceleration_mps2, 100.0, -wire::kAccelerationMax,
                                                   wire::kAccelerationMax, kAccelerationUnavailable)
                                        : kAccelerationUnavailable;
  const auto unsigned_value = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };

  wire::Writer writer(frames.payload);
  writer.unsigned_field(1, message.count);
  writer.fixed64_field(2, message.temporary_id);
  writer.unsigned_field(3, message.second_mark_ms);
  wire::write_position(writer, 4, position.latitude_e7, position.longitude_e7);
  writer.unsigned_field(5, unsigned_value(kForwardGears));
  writer.unsigned_field(6, unsigned_value(wire::speed_units(message.speed_mps)));
  writer.unsigned_field(7, unsigned_value(wire::heading_units(message.heading_rad)));
  wire::write_acceleration(writer, 8, acceleration);
  const std::size_t brakes = writer.open(9);
  writer.unsigned_field(1, unsigned_value(message.braking ? kPedalOn : kPedalOff));
  writer.close(brakes);
  wire::write_size(writer, 10, message.width_m, message.length_m);
  writer.unsigned_field(11, wire::kPassengerCar);
  std::uint32_t bits = kWireBits;
  if (message.accuracy_m) {
    const std::uint64_t axis =
        unsigned_value(to_units(*message.accuracy_m, kAccuracyUnitsPerM, 0, kAccuracyMax, kAccuracyUnavailable));
    const std::size_t accuracy = writer.open(12);
    writer.unsigned_field(1, axis);
    writer.unsigned_field(2, axis);
    writer.unsigned_field(3, unsigned_value(kOrientationUnavailable));
    writer.close(accuracy);
    bits += kAccuracyBits;
  }
  wire::finish_frame(writer, frames, envelope, FrameKind::kBsm, (bits + 7) / 8);
}

Expected<BasicSafety> decode_bsm(std::span<const std::uint8_t> payload) {
  const Raw raw = read(payload);
  wire::Check check;
  check.that("the encoding", !raw.broken && !raw.size.broken);
  check.required("msg_count", raw.count, 0, wire::kCountMax);
  check.that("id", raw.has_id);
  check.required("second_mark_ms", raw.second_mark_ms, 0, wire::kSecondMarkMax);
  wire::check_position(check, "position", raw.position);
  check.required("transmission", raw.transmission, 0, 7);
  check.required("speed_2cmps", raw.speed, 0, wire::kSpeedUnavailable);
  check.required("heading_80th_deg", raw.heading, 0, wire::kHeadingUnavailable);
  check.required("acceleration.longitudinal_cmps2", raw.acceleration, -wire::kAccelerationMax,
                 kAccelerationUnavailable);
  check.that("brakes", raw.has_brakes);
  check.optional("brakes.pedal", raw.pedal, 0, kPedalOn);
  check.required("size.width_cm", raw.size.width_cm, 0, wire::kWidthMax_cm);
  check.required("size.length_cm", raw.size.length_cm, 0, wire::kLengthMax_cm);
  check.required("vehicle_class", raw.vehicle_class, 0, 255);
  if (raw.has_accuracy) {
    check.required("accuracy.semi_major_5cm", raw.semi_major, 0, kAccuracyUnavailable);
    check.required("accuracy.semi_minor_5cm", raw.semi_minor, 0, kAccuracyUnavailable);
    check.required("accuracy.orientation", raw.orientation, 0, kOrientationUnavailable);
  }
  if (!check.ok()) return check.error("BSM");
  const auto centre = to_plane(
      {static_cast<std::int32_t>(raw.position.latitude_e7), static_cast<std::int32_t>(raw.position.longitude_e7)});
  if (!centre) return Error{"BSM", "the position is unavailable"};

  BasicSafety message;
  message.temporary_id = raw.id;
  message.count = static_cast<std::uint8_t>(raw.count);
  message.second_mark_ms = static_cast<std::uint16_t>(raw.second_mark_ms);
  message.centre = *centre;
  message.speed_mps = wire::speed_mps(raw.speed);
  message.heading_rad = wire::heading_rad(raw.heading);
  if (raw.acceleration != kAccelerationUnavailable) {
    message.acceleration_mps2 = static_cast<double>(raw.acceleration) / 100.0;
  }
  message.braking = raw.pedal == kPedalOn;
  message.width_m = static_cast<double>(raw.size.width_cm) / 100.0;
  message.length_m = static_cast<double>(raw.size.length_cm) / 100.0;
  if (raw.has_accuracy && raw.semi_major != kAccuracyUnavailable) {
    message.accuracy_m = static_cast<double>(raw.semi_major) / kAccuracyUnitsPerM;
  }
  return message;
}

PlanePoint centre_of_car(const PlanePoint& front, double heading_rad, double length_m) {
  return {.x_m = front.x_m - 0.5 * length_m * math::sin(heading_rad),
          .y_m = front.y_m - 0.5 * length_m * math::cos(heading_rad)};
}

}  // namespace lukou
