#include "common/messages/rsm.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "common/core/contract.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using wire::fixed64_key;
using wire::kAbsent;
using wire::message_key;
using wire::to_units;
using wire::varint_key;

constexpr std::int64_t kTypeMax = 4;
constexpr std::int64_t kSourceMax = 7;
/// Accuracies of the classes 1 to 15 [m]; class 0 is "unavailable".
constexpr std::array<double, 15> kAccuracy_m = {500.0, 200.0, 100.0, 50.0, 20.0, 10.0, 5.0, 2.0,
                                                1.0,   0.5,   0.2,   0.1,  0.05, 0.02, 0.01};

// UPER in bits. Head: frame 4; presence 1; count 7; id 64; position with elevation 80; number of participants 4.
constexpr std::uint32_t kHeadBits = 160;
// Always there: presence 7; type 4; number 16; source 4; second 16; presence and kind of the offset 4; confidence of
// the position 5; speed 13; heading 15; size 23.
constexpr std::uint32_t kParticipantBits = 107;

std::int64_t accuracy_class(const std::optional<double>& accuracy_m) {
  if (!accuracy_m || !(*accuracy_m <= kAccuracy_m.front())) return 0;
  std::size_t finest = 0;
  while (finest + 1 < kAccuracy_m.size() && kAccuracy_m[finest + 1] >= *accuracy_m) ++finest;
  return static_cast<std::int64_t>(finest) + 1;
}

/// Bits of the two offsets in the narrowest of the standard's six forms.
std::uint32_t offset_bits(std::int64_t units) {
  for (const std::uint32_t bits : {12U, 14U, 16U, 18U, 22U}) {
    if (units < (std::int64_t{1} << (bits - 1))) return 2 * bits;
  }
  return 2 * 24;
}

/// The larger of a point's two offsets from the reference.
std::int64_t offset_of(const PlanePoint& point) {
  const GeoPoint geo = to_geo(point);
  return std::max(std::abs(std::int64_t{geo.latitude_e7} - kGeoReference.latitude_e7),
                  std::abs(std::int64_t{geo.longitude_e7} - kGeoReference.longitude_e7));
}

void write_participant(wire::Writer& writer, const Participant& participant) {
  const auto unsigned_value = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  const std::size_t begin = writer.open(4);
  writer.unsigned_field(1, static_cast<std::uint64_t>(participant.type));
  writer.unsigned_field(2, participant.number);
  writer.unsigned_field(3, static_cast<std::uint64_t>(participant.source));
  if (participant.vehicle) writer.fixed64_field(4, *participant.vehicle);
  writer.unsigned_field(5, participant.second_mark_ms);
  wire::write_offset(writer, 6, participant.centre);
  writer.unsigned_field(7, unsigned_value(accuracy_class(participant.accuracy_m)));
  writer.unsigned_field(8, unsigned_value(wire::speed_units(participant.speed_mps)));
  writer.unsigned_field(9, unsigned_value(wire::heading_units(participant.heading_rad)));
  wire::write_size(writer, 10, participant.width_m, participant.length_m);
  writer.unsigned_field(11, wire::kPassengerCar);
  writer.close(begin);
}

struct RawParticipant {
  std::int64_t type = kAbsent;
  std::int64_t number = kAbsent;
  std::int64_t source = kAbsent;
  std::optional<std::uint64_t> vehicle;
  std::int64_t second_mark_ms = kAbsent;
  wire::RawPosition position;
  std::int64_t confidence = kAbsent;
  std::int64_t speed = kAbsent;
  std::int64_t heading = kAbsent;
  wire::RawSize size;
  std::int64_t vehicle_class = kAbsent;
  bool broken = false;
};

RawParticipant read_participant(std::span<const std::uint8_t> bytes) {
  RawParticipant raw;
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        raw.type = reader.value();
        break;
      case varint_key(2):
        raw.number = reader.value();
        break;
      case varint_key(3):
        raw.source = reader.value();
        break;
      case fixed64_key(4):
        raw.vehicle = reader.bits();
        break;
      case varint_key(5):
        raw.second_mark_ms = reader.value();
        break;
      case message_key(6):
        wire::read_position(reader.message(), raw.position);
        break;
      case varint_key(7):
        raw.confidence = reader.value();
        break;
      case varint_key(8):
        raw.speed = reader.value();
        break;
      case varint_key(9):
        raw.heading = reader.value();
        break;
      case message_key(10):
        wire::read_size(reader.message(), raw.size);
        break;
      case varint_key(11):
        raw.vehicle_class = reader.value();
        break;
      default:
        break;  // a later edition's field
    }
  }
  raw.broken = raw.broken || reader.broken();
  return raw;
}

/// Adds the participant to the message, or says in `check` what is wrong with it.
void take_participant(const RawParticipant& raw, const wire::RawPosition& reference, RoadsideSafety& message,
                      wire::Check& check) {
  check.that("the encoding of a participant", !raw.broken && !raw.size.broken);
  check.required("participant.type", raw.type, 0, kTypeMax);
  check.required("participant.id", raw.number, 0, 65'535);
  check.required("participant.source", raw.source, 0, kSourceMax);
  check.required("participant.second_mark_ms", raw.second_mark_ms, 0, wire::kSecondMarkMax);
  wire::check_offset(check, "participant.position", raw.position);
  check.required("participant.position_confidence", raw.confidence, 0, kAccuracy_m.size());
  check.required("participant.speed_2cmps", raw.speed, 0, wire::kSpeedUnavailable);
  check.required("participant.heading_80th_deg", raw.heading, 0, wire::kHeadingUnavailable);
  check.required("participant.size.width_cm", raw.size.width_cm, 0, wire::kWidthMax_cm);
  check.required("participant.size.length_cm", raw.size.length_cm, 0, wire::kLengthMax_cm);
  check.optional("participant.vehicle_class", raw.vehicle_class, 0, 255);
  if (!check.ok()) return;
  const auto centre = wire::point_at(reference, raw.position);
  check.that("the reference position", centre.has_value());
  if (!check.ok()) return;
  Participant participant{.type = static_cast<ParticipantType>(raw.type),
                          .number = static_cast<std::uint16_t>(raw.number),
                          .source = static_cast<ParticipantSource>(raw.source),
                          .vehicle = raw.vehicle,
                          .second_mark_ms = static_cast<std::uint16_t>(raw.second_mark_ms),
                          .centre = *centre,
                          .accuracy_m = {},
                          .speed_mps = wire::speed_mps(raw.speed),
                          .heading_rad = wire::heading_rad(raw.heading),
                          .width_m = static_cast<double>(raw.size.width_cm) / 100.0,
                          .length_m = static_cast<double>(raw.size.length_cm) / 100.0};
  if (raw.confidence > 0) participant.accuracy_m = kAccuracy_m[static_cast<std::size_t>(raw.confidence - 1)];
  message.participants.push_back(participant);
}

}  // namespace

bool fits_offset(const PlanePoint& point) {
  return to_geo(point) != kGeoUnavailable && offset_of(point) <= wire::kOffsetMax;
}

std::uint32_t participant_bits(const ParticipantFields& fields, std::int64_t offset_units) {
  std::uint32_t bits = kParticipantBits + offset_bits(offset_units);
  if (fields.vehicle_id) bits += 64;
  if (fields.transmission) bits += 3;
  if (fields.steering_angle) bits += 8;
  if (fields.motion_confidence) bits += 11;  // presence 3; speed 3; heading 3; angle 2
  if (fields.accelerations) bits += 48;
  if (fields.height) bits += 7;
  if (fields.vehicle_class) bits += 10;
  return bits;
}

std::uint32_t rsm_bytes(std::uint32_t bits) { return (kHeadBits + bits + 7) / 8; }

void append(Frames& frames, const Envelope& envelope, const RoadsideSafety& message) {
  LUKOU_EXPECT(message.count <= wire::kCountMax);
  LUKOU_EXPECT(!message.participants.empty() && message.participants.size() <= kMaxParticipants);
  wire::Writer writer(frames.payload);
  writer.unsigned_field(1, message.count);
  writer.fixed64_field(2, message.rsu);
  wire::write_position(writer, 3, kGeoReference.latitude_e7, kGeoReference.longitude_e7);
  std::uint32_t bits = 0;
  for (const Participant& participant : message.participants) {
    LUKOU_EXPECT(participant.second_mark_ms <= wire::kSecondMarkMax && fits_offset(participant.centre));
    write_participant(writer, participant);
    bits += participant_bits({.vehicle_id = participant.vehicle.has_value(), .vehicle_class = true},
                             offset_of(participant.centre));
  }
  wire::finish_frame(writer, frames, envelope, FrameKind::kRsm, rsm_bytes(bits));
}

Expected<RoadsideSafety> decode_rsm(std::span<const std::uint8_t> payload) {
  // The participants follow in a second walk: they are told from the reference, which may stand behind them.
  std::int64_t count = kAbsent;
  bool has_id = false;
  wire::RawPosition reference;
  std::size_t participants = 0;
  RoadsideSafety message;
  wire::Reader reader(payload);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        count = reader.value();
        break;
      case fixed64_key(2):
        message.rsu = reader.bits(), has_id = true;
        break;
      case message_key(3):
        wire::read_position(reader.message(), reference);
        break;
      case message_key(4):
        ++participants;
        break;
      default:
        break;
    }
  }
  wire::Check check;
  check.that("the encoding", !reader.broken());
  check.required("msg_count", count, 0, wire::kCountMax);
  check.that("id", has_id);
  wire::check_position(check, "reference", reference);
  check.that("the number of participants", participants >= 1 && participants <= kMaxParticipants);
  if (!check.ok()) return check.error("RSM");
  message.count = static_cast<std::uint8_t>(count);
  message.participants.reserve(participants);
  wire::Reader again(payload);
  while (again.next() && check.ok()) {
    if (again.field() == message_key(4)) take_participant(read_participant(again.message()), reference, message, check);
  }
  if (!check.ok()) return check.error("RSM");
  return message;
}

}  // namespace lukou
