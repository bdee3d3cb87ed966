#include "common/messages/rsc.hpp"

#include "common/core/contract.hpp"
#include "common/messages/map.hpp"
#include "common/messages/rsc_fields.hpp"
#include "common/messages/wire.hpp"

namespace lukou {
namespace {

using namespace rsc;

constexpr std::uint64_t kSlowDown = 1U << 11U;
constexpr std::uint64_t kSpeedUp = 1U << 12U;

// UPER in bytes, as counted for the standard's message: its head, each suggestion, each point with acceleration.
constexpr std::uint32_t kHeadBytes = 24;
constexpr std::uint32_t kSuggestionBytes = 14;
constexpr std::uint32_t kPointBytes = 17;
// A point has 13 bits of speed in place of 48 of acceleration: 136 - 48 + 13 = 101 bits.
constexpr std::uint32_t kSpeedPointBytes = 13;
// A lane: 8 flags, its link of two nodes (1 + 16 bits each) and lanes (1 + 16), a speed (13), and an end of 6 flags,
// hour (5), minute (6) and millisecond (16): 105 bits.
constexpr std::uint32_t kLaneBytes = 14;

std::int64_t acceleration_units(double acceleration_mps2) {
  return wire::to_units(acceleration_mps2, 100.0, -wire::kAccelerationMax, wire::kAccelerationMax, 0);
}

bool fits_acceleration(double acceleration_mps2) { return acceleration_mps2 >= -20.0 && acceleration_mps2 <= 20.0; }
bool fits_speed(double speed_mps) { return speed_mps >= 0.0 && speed_mps <= 163.8; }
bool fits_lifetime(std::uint32_t lifetime_ms) {
  return lifetime_ms >= kLifetimeUnit_ms && lifetime_ms <= kLifetimeMax * kLifetimeUnit_ms &&
         lifetime_ms % kLifetimeUnit_ms == 0;
}

void write_point(wire::Writer& writer, const PlanePoint& centre, double acceleration_mps2, std::uint32_t from_ms) {
  const std::size_t point = writer.open(1);
  wire::write_offset(writer, 1, centre);
  wire::write_acceleration(writer, 4, acceleration_units(acceleration_mps2));
  writer.unsigned_field(5, from_ms / kLifetimeUnit_ms);
  writer.close(point);
}

void write_path(wire::Writer& writer, const GuidedPath& guided) {
  const std::int64_t acceleration = guided.speed_mps ? 0 : acceleration_units(guided.acceleration_mps2);
  const std::size_t suggestion = writer.open(2);
  writer.unsigned_field(1, acceleration > 0 ? kSpeedUp : (acceleration < 0 ? kSlowDown : 0));
  writer.unsigned_field(2, guided.lifetime_ms / kLifetimeUnit_ms);
  writer.close(suggestion);
  const std::size_t path = writer.open(3);
  if (guided.speed_mps) {
    const std::size_t point = writer.open(1);
    wire::write_offset(writer, 1, guided.centre);
    writer.unsigned_field(2, static_cast<std::uint64_t>(wire::speed_units(guided.speed_mps)));
    writer.unsigned_field(5, 0);
    writer.close(point);
  } else {
    write_point(writer, guided.centre, guided.acceleration_mps2, 0);
    for (const LaterAcceleration& later : guided.later) {
      write_point(writer, later.centre, later.acceleration_mps2, later.from_ms);
    }
  }
  writer.close(path);
}

void write_vehicle(wire::Writer& writer, const VehicleCoordination& vehicle) {
  const std::size_t begin = writer.open(5);
  writer.fixed64_field(1, vehicle.vehicle);
  if (vehicle.path) write_path(writer, *vehicle.path);
  if (vehicle.binding != Binding::kGuard) {
    writer.unsigned_field(kBindingField, static_cast<std::uint64_t>(vehicle.binding));
  }
  writer.close(begin);
}

std::uint32_t path_bytes(const std::optional<GuidedPath>& path) {
  if (!path) return 0;
  return path->speed_mps ? kSpeedPointBytes : kPointBytes * static_cast<std::uint32_t>(1 + path->later.size());
}

void write_lane(wire::Writer& writer, std::uint16_t node, const LaneSpeed& advice) {
  const std::size_t begin = writer.open(6);
  const std::size_t link = writer.open(1);
  writer.unsigned_field(1, kFirstNeighbour + static_cast<std::uint32_t>(approach_of(advice.lane)));
  writer.unsigned_field(2, node);
  writer.unsigned_field(3, std::uint64_t{2} << static_cast<unsigned>(turn_of(advice.lane)));
  writer.close(link);
  writer.unsigned_field(2, static_cast<std::uint64_t>(wire::speed_units(advice.speed_mps)));
  writer.unsigned_field(kLaneLifetimeField, advice.lifetime_ms / kLifetimeUnit_ms);
  writer.close(begin);
}

}  // namespace

bool fits(const GuidedPath& path) {
  if (!fits_lifetime(path.lifetime_ms)) return false;
  if (path.speed_mps) return fits_speed(*path.speed_mps) && path.later.empty();
  if (!fits_acceleration(path.acceleration_mps2) || path.later.size() >= kMaxPathPoints) return false;
  std::uint32_t before_ms = 0;
  for (const LaterAcceleration& later : path.later) {
    if (!fits_acceleration(later.acceleration_mps2) || later.from_ms <= before_ms ||
        later.from_ms >= path.lifetime_ms || later.from_ms % kLifetimeUnit_ms != 0) {
      return false;
    }
    before_ms = later.from_ms;
  }
  return true;
}

bool fits(const LaneSpeed& advice) { return fits_speed(advice.speed_mps) && fits_lifetime(advice.lifetime_ms); }

void append(Frames& frames, const Envelope& envelope, const Coordination& message) {
  LUKOU_EXPECT(message.count <= wire::kCountMax && message.second_mark_ms <= wire::kSecondMarkMax);
  LUKOU_EXPECT(message.vehicles.size() <= kMaxCoordinations && message.lanes.size() <= kMaxLaneCoordinations);
  wire::Writer writer(frames.payload);
  writer.unsigned_field(1, message.count);
  writer.fixed64_field(2, message.rsu);
  writer.unsigned_field(3, message.second_mark_ms);
  wire::write_position(writer, 4, kGeoReference.latitude_e7, kGeoReference.longitude_e7);
  std::uint32_t wire_bytes = kHeadBytes;
  for (const VehicleCoordination& vehicle : message.vehicles) {
    LUKOU_EXPECT(!vehicle.path || fits(*vehicle.path));
    write_vehicle(writer, vehicle);
    wire_bytes += kSuggestionBytes + path_bytes(vehicle.path);
  }
  for (const LaneSpeed& advice : message.lanes) {
    LUKOU_EXPECT(fits(advice));
    write_lane(writer, message.node, advice);
    wire_bytes += kLaneBytes;
  }
  wire::finish_frame(writer, frames, envelope, FrameKind::kRsc, wire_bytes);
}

}  // namespace lukou
