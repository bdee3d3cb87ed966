#include "common/messages/spat.hpp"

#include "common/core/contract.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using wire::kAbsent;
using wire::message_key;
using wire::varint_key;

// Lights of the standard that our heads can show.
constexpr std::int64_t kRedLight = 3;
constexpr std::int64_t kPermissiveGreenLight = 5;
constexpr std::int64_t kProtectedGreenLight = 6;
constexpr std::int64_t kYellowLight = 7;
constexpr std::int64_t kLightMax = 8;
constexpr Step kHourOrLater_ds = 36'000;
constexpr Step kUnknown_ds = 36'001;

// UPER in bits. Head 113: frame 4; presence 4; count 7; minute 20; second 16; number of intersections 5; presence 4;
// node with region 33; status 16; number of phases 4. Phase 12: id 8; number of states 4. State 46: presence 2; light
// 5; kind of times 2; presence 5; start 16; likely end 16.
constexpr std::size_t kHeadBits = 113;
constexpr std::size_t kPhaseBits = 12;
constexpr std::size_t kStateBits = 46;

std::int64_t light_of(Aspect aspect) {
  switch (aspect) {
    case Aspect::kRed:
      return kRedLight;
    case Aspect::kYellow:
      return kYellowLight;
    case Aspect::kGreen:
      break;
  }
  return kPermissiveGreenLight;
}

std::uint64_t time_mark(Step from_now) {
  LUKOU_EXPECT(from_now >= 0);
  return static_cast<std::uint64_t>(from_now < kHourOrLater_ds ? from_now : kHourOrLater_ds);
}

/// Reads a PhaseState.
PhaseState read_state(std::span<const std::uint8_t> bytes, wire::Check& check) {
  std::int64_t light = kAbsent;
  std::int64_t start = kAbsent;
  std::int64_t likely_end = kAbsent;
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) light = reader.value();
    if (reader.field() != message_key(2)) continue;
    wire::Reader counting(reader.message());
    while (counting.next()) {
      if (counting.field() == varint_key(1)) start = counting.value();
      if (counting.field() == varint_key(4)) likely_end = counting.value();
    }
    check.that("the encoding of a time", !counting.broken());
  }
  check.that("the encoding of a state", !reader.broken());
  check.required("light", light, 0, kLightMax);
  check.that("a light that is red, green or yellow",
             light == kRedLight || (light >= kPermissiveGreenLight && light <= kYellowLight));
  check.required("counting.start_ds", start, 0, kHourOrLater_ds);
  check.required("counting.likely_end_ds", likely_end, 0, kUnknown_ds);
  PhaseState state{.aspect = Aspect::kRed, .starts_in = start, .ends_in = std::nullopt};
  if (likely_end != kUnknown_ds) state.ends_in = likely_end;
  if (light == kYellowLight) state.aspect = Aspect::kYellow;
  if (light == kPermissiveGreenLight || light == kProtectedGreenLight) state.aspect = Aspect::kGreen;
  return state;
}

void read_phase(std::span<const std::uint8_t> bytes, Spat& message, wire::Check& check) {
  std::int64_t id = kAbsent;
  std::vector<PhaseState> states;
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) id = reader.value();
    if (reader.field() == message_key(2)) states.push_back(read_state(reader.message(), check));
  }
  check.that("the encoding of a phase", !reader.broken());
  check.required("phase id", id, 1, kLanes);
  check.that("the number of states", !states.empty() && states.size() <= kMaxPhaseStates);
  if (!check.ok()) return;
  auto& lane = message.lanes[static_cast<std::size_t>(id - 1)];
  check.that("a phase that comes once", lane.empty());
  lane = std::move(states);
}

struct RawHead {
  std::int64_t count = kAbsent;
  std::int64_t minute = kAbsent;
  std::int64_t second_mark_ms = kAbsent;
  std::int64_t node = kAbsent;
  std::int64_t status = kAbsent;
  std::size_t intersections = 0;
};

void read_intersection(std::span<const std::uint8_t> bytes, RawHead& head, Spat& message, wire::Check& check) {
  ++head.intersections;
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) head.node = reader.value();
    if (reader.field() == varint_key(2)) head.status = reader.value();
    if (reader.field() == message_key(3)) read_phase(reader.message(), message, check);
  }
  check.that("the encoding of an intersection", !reader.broken());
}

}  // namespace

void append(Frames& frames, const Envelope& envelope, const Spat& message) {
  LUKOU_EXPECT(message.count <= wire::kCountMax && message.second_mark_ms <= wire::kSecondMarkMax);
  LUKOU_EXPECT(message.minute_of_year <= wire::kMinuteMax);
  wire::Writer writer(frames.payload);
  writer.unsigned_field(1, message.count);
  writer.unsigned_field(2, message.minute_of_year);
  writer.unsigned_field(3, message.second_mark_ms);
  const std::size_t intersection = writer.open(4);
  writer.unsigned_field(1, message.node);
  writer.unsigned_field(2, 0);
  std::size_t bits = kHeadBits;
  for (std::size_t lane = 0; lane < message.lanes.size(); ++lane) {
    const std::vector<PhaseState>& states = message.lanes[lane];
    LUKOU_EXPECT(!states.empty() && states.size() <= kMaxPhaseStates);
    const std::size_t phase = writer.open(3);
    writer.unsigned_field(1, lane + 1);
    for (const PhaseState& state : states) {
      const std::size_t begin = writer.open(2);
      writer.unsigned_field(1, static_cast<std::uint64_t>(light_of(state.aspect)));
      const std::size_t counting = writer.open(2);
      writer.unsigned_field(1, time_mark(state.starts_in));
      writer.unsigned_field(4, state.ends_in ? time_mark(*state.ends_in) : static_cast<std::uint64_t>(kUnknown_ds));
      writer.close(counting);
      writer.close(begin);
    }
    writer.close(phase);
    bits += kPhaseBits + kStateBits * states.size();
  }
  writer.close(intersection);
  wire::finish_frame(writer, frames, envelope, FrameKind::kSpat, static_cast<std::uint32_t>((bits + 7) / 8));
}

Expected<Spat> decode_spat(std::span<const std::uint8_t> payload) {
  Spat message;
  RawHead head;
  wire::Check check;
  wire::Reader reader(payload);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        head.count = reader.value();
        break;
      case varint_key(2):
        head.minute = reader.value();
        break;
      case varint_key(3):
        head.second_mark_ms = reader.value();
        break;
      case message_key(4):
        read_intersection(reader.message(), head, message, check);
        break;
      default:
        break;
    }
  }
  check.that("the encoding", !reader.broken());
  check.required("msg_count", head.count, 0, wire::kCountMax);
  check.required("minute_of_year", head.minute, 0, wire::kMinuteMax);
  check.required("second_mark_ms", head.second_mark_ms, 0, wire::kSecondMarkMax);
  check.that("the number of intersections", head.intersections == 1);
  check.required("node_id", head.node, 0, 65'535);
  check.required("status_bits", head.status, 0, 65'535);
  for (const auto& lane : message.lanes) check.that("a phase of every lane", !lane.empty());
  if (!check.ok()) return check.error("SPAT");
  message.count = static_cast<std::uint8_t>(head.count);
  message.minute_of_year = static_cast<std::uint32_t>(head.minute);
  message.second_mark_ms = static_cast<std::uint16_t>(head.second_mark_ms);
  message.node = static_cast<std::uint16_t>(head.node);
  return message;
}

}  // namespace lukou
