#include "common/messages/map.hpp"

#include <algorithm>
#include <vector>

#include "common/core/contract.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using wire::kAbsent;
using wire::message_key;
using wire::varint_key;

constexpr std::uint32_t kHighestSpeedOfVehicles = 5;
constexpr std::int64_t kWidthMax_cm = 32'767 / kLanesPerApproach;  // so that a link's width fits, too

// UPER in bytes of four links of three lanes: everything but the points, and one point more in each lane and link.
constexpr std::uint32_t kHeadBytes = 354;
constexpr std::uint32_t kPointsBytes = 74;

std::uint64_t maneuver_bit(Turn turn) {
  switch (turn) {
    case Turn::kLeft:
      return 1U << 1U;
    case Turn::kRight:
      return 1U << 2U;
    case Turn::kCenter:
      break;
  }
  return 1U;
}

/// Side that a lane leads to: approaches run counter-clockwise from the west, so a left turn leads one place back.
std::uint32_t exit_side(Lane lane) {
  const auto from = static_cast<std::uint32_t>(approach_of(lane));
  switch (turn_of(lane)) {
    case Turn::kLeft:
      return (from + 3) % kApproaches;
    case Turn::kRight:
      return (from + 1) % kApproaches;
    case Turn::kCenter:
      break;
  }
  return (from + 2) % kApproaches;
}

void write_lane(wire::Writer& writer, const MapData& message, Lane lane, std::uint64_t width_cm) {
  const std::uint64_t place = static_cast<std::uint64_t>(turn_of(lane)) + 1;
  const std::size_t begin = writer.open(4);
  writer.unsigned_field(1, place);
  writer.unsigned_field(2, width_cm);
  writer.unsigned_field(3, maneuver_bit(turn_of(lane)));
  const std::size_t connection = writer.open(4);
  writer.unsigned_field(1, kFirstNeighbour + exit_side(lane));
  writer.unsigned_field(2, place);
  writer.unsigned_field(3, maneuver_bit(turn_of(lane)));
  writer.unsigned_field(4, index(lane) + 1);
  writer.close(connection);
  wire::write_offset(writer, 5, message.lanes[index(lane)].entrance);
  wire::write_offset(writer, 5, message.lanes[index(lane)].stop_line);
  writer.close(begin);
}

struct RawLane {
  std::int64_t id = kAbsent;
  std::int64_t width_cm = kAbsent;
  std::int64_t phase = kAbsent;
  std::vector<wire::RawPosition> points;
};

struct Raw {
  std::int64_t count = kAbsent;
  std::int64_t minute = kAbsent;
  std::size_t nodes = 0;
  std::int64_t node = kAbsent;
  wire::RawPosition reference;
  std::int64_t speed = kAbsent;
  std::vector<RawLane> lanes;
  bool broken = false;
};

RawLane read_lane(std::span<const std::uint8_t> bytes, Raw& raw) {
  RawLane lane;
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        lane.id = reader.value();
        break;
      case varint_key(2):
        lane.width_cm = reader.value();
        break;
      case message_key(4): {
        wire::Reader connection(reader.message());
        while (connection.next()) {
          if (connection.field() == varint_key(4)) lane.phase = connection.value();
        }
        raw.broken = raw.broken || connection.broken();
        break;
      }
      case message_key(5):
        wire::read_position(reader.message(), lane.points.emplace_back());
        break;
      default:
        break;
    }
  }
  raw.broken = raw.broken || reader.broken();
  return lane;
}

void read_link(std::span<const std::uint8_t> bytes, Raw& raw) {
  wire::Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == message_key(4)) raw.lanes.push_back(read_lane(reader.message(), raw));
    if (reader.field() != message_key(2)) continue;
    wire::Reader limit(reader.message());
    while (limit.next()) {
      if (limit.field() == varint_key(2)) raw.speed = limit.value();
    }
    raw.broken = raw.broken || limit.broken();
  }
  raw.broken = raw.broken || reader.broken();
}

void read_node(std::span<const std::uint8_t> bytes, Raw& raw) {
  ++raw.nodes;
  wire::Reader reader(bytes);
  while (reader.next()) {
    switch (reader.field()) {
      case varint_key(1):
        raw.node = reader.value();
        break;
      case message_key(2):
        wire::read_position(reader.message(), raw.reference);
        break;
      case message_key(3):
        read_link(reader.message(), raw);
        break;
      default:
        break;
    }
  }
  raw.broken = raw.broken || reader.broken();
}

/// Puts a lane where its phase id says, or says in `check` what is wrong with it.
void take_lane(const RawLane& raw, const wire::RawPosition& reference, MapData& message, std::vector<bool>& seen,
               wire::Check& check) {
  check.required("lane_id", raw.id, 0, 255);
  check.required("lane.width_cm", raw.width_cm, 0, kWidthMax_cm);
  check.required("lane.phase_id", raw.phase, 1, kLanes);
  check.that("the number of points of a lane", raw.points.size() >= 2);
  for (const wire::RawPosition& point : raw.points) wire::check_offset(check, "a point of a lane", point);
  if (!check.ok()) return;
  const auto lane = static_cast<std::size_t>(raw.phase - 1);
  const auto entrance = wire::point_at(reference, raw.points.front());
  const auto stop_line = wire::point_at(reference, raw.points.back());
  check.that("the reference position", entrance.has_value() && stop_line.has_value());
  check.that("a lane that comes once", !seen[lane]);
  if (!check.ok()) return;
  seen[lane] = true;
  message.lane_width_m = static_cast<double>(raw.width_cm) / 100.0;
  message.lanes[lane] = {*entrance, *stop_line};
}

}  // namespace

void append(Frames& frames, const Envelope& envelope, const MapData& message) {
  LUKOU_EXPECT(message.count <= wire::kCountMax && message.minute_of_year <= wire::kMinuteMax);
  const auto width_cm = static_cast<std::uint64_t>(wire::to_units(message.lane_width_m, 100.0, 0, kWidthMax_cm, 0));
  const auto speed = static_cast<std::uint64_t>(
      wire::to_units(message.speed_limit_mps, wire::kSpeedUnitsPerMps, 0, wire::kSpeedMax, 0));
  wire::Writer writer(frames.payload);
  writer.unsigned_field(1, message.count);
  writer.unsigned_field(2, message.minute_of_year);
  const std::size_t node = writer.open(3);
  writer.unsigned_field(1, message.node);
  wire::write_position(writer, 2, kGeoReference.latitude_e7, kGeoReference.longitude_e7);
  for (const Approach approach : kAllApproaches) {
    const std::size_t link = writer.open(3);
    writer.unsigned_field(1, kFirstNeighbour + index(approach));
    const std::size_t limit = writer.open(2);
    writer.unsigned_field(1, kHighestSpeedOfVehicles);
    writer.unsigned_field(2, speed);
    writer.close(limit);
    writer.unsigned_field(3, kLanesPerApproach * width_cm);
    for (const Turn turn : {Turn::kLeft, Turn::kCenter, Turn::kRight}) {
      write_lane(writer, message, lane_of(approach, turn), width_cm);
    }
    writer.close(link);
  }
  writer.close(node);
  wire::finish_frame(writer, frames, envelope, FrameKind::kMap, kHeadBytes + 2 * kPointsBytes);
}

Expected<MapData> decode_map(std::span<const std::uint8_t> payload) {
  Raw raw;
  wire::Reader reader(payload);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) raw.count = reader.value();
    if (reader.field() == varint_key(2)) raw.minute = reader.value();
    if (reader.field() == message_key(3)) read_node(reader.message(), raw);
  }
  wire::Check check;
  check.that("the encoding", !reader.broken() && !raw.broken);
  check.required("msg_count", raw.count, 0, wire::kCountMax);
  check.required("minute_of_year", raw.minute, 0, wire::kMinuteMax);
  check.that("the number of nodes", raw.nodes == 1);
  check.required("node id", raw.node, 0, 65'535);
  check.required("speed_limits.speed_2cmps", raw.speed, 0, wire::kSpeedMax);
  wire::check_position(check, "reference", raw.reference);
  MapData message;
  std::vector<bool> seen(kLanes, false);
  for (const RawLane& lane : raw.lanes) take_lane(lane, raw.reference, message, seen, check);
  check.that("a lane", std::ranges::count(seen, true) == kLanes);
  if (!check.ok()) return check.error("MAP");
  message.count = static_cast<std::uint8_t>(raw.count);
  message.minute_of_year = static_cast<std::uint32_t>(raw.minute);
  message.node = static_cast<std::uint16_t>(raw.node);
  message.speed_limit_mps = static_cast<double>(raw.speed) / wire::kSpeedUnitsPerMps;
  return message;
}

}  // namespace lukou
