#include "services/rsu/guided_path.hpp"

#include <algorithm>

#include "common/core/math.hpp"

namespace lukou {
namespace {

constexpr Step kLongestLifetime = 65'534 / 10;  // steps that the field of 10 ms units holds

/// Longer ones stay too long, shorter ones too short: they do not fit.
std::uint32_t lifetime_ms(Step lifetime) {
  return static_cast<std::uint32_t>(std::clamp<Step>(lifetime, 0, kLongestLifetime + 1) * kStep_ms);
}

/// A car that drives on along a straight line.
struct Ahead {
  PlanePoint centre;
  double heading_rad = 0.0;
  double speed_mps = 0.0;

  void drive(Step steps, double acceleration_mps2) {
    const double duration_s = time_s(steps);
    const double next_mps = std::max(0.0, speed_mps + acceleration_mps2 * duration_s);
    const double way_m = (speed_mps + next_mps) / 2.0 * duration_s;
    centre.x_m += way_m * math::sin(heading_rad);
    centre.y_m += way_m * math::cos(heading_rad);
    speed_mps = next_mps;
  }
};

GuidedPath path_of(const AccelerationProfile& profile, Ahead ahead) {
  if (profile.segments.size() > kMaxPathPoints) return {};
  GuidedPath path{.centre = ahead.centre};
  Step life = 0;
  for (const AccelerationSegment& segment : profile.segments) {
    const bool carried = segment.duration >= 1 && segment.duration <= kLongestLifetime &&
                         segment.acceleration_mps2 >= -20.0 && segment.acceleration_mps2 <= 20.0;
    if (!carried) return {};
    if (life == 0) {
      path.acceleration_mps2 = segment.acceleration_mps2;
    } else {
      path.later.push_back(
          {.from_ms = lifetime_ms(life), .acceleration_mps2 = segment.acceleration_mps2, .centre = ahead.centre});
    }
    ahead.drive(segment.duration, segment.acceleration_mps2);
    life += segment.duration;
  }
  path.lifetime_ms = lifetime_ms(life);
  return path;
}

}  // namespace

std::optional<GuidedPath> guided_path(const RsuAnswer::Item& item, const CarReport* car) {
  if (item.is_release()) return std::nullopt;
  Ahead ahead;
  if (car != nullptr) {
    ahead = {{car->place.centre_x_m, car->place.centre_y_m}, car->place.heading_rad, car->speed_mps};
  }
  if (item.profile) return path_of(*item.profile, ahead);
  if (item.speed) {
    return GuidedPath{
        .centre = ahead.centre, .lifetime_ms = lifetime_ms(item.speed->lifetime), .speed_mps = item.speed->speed_mps};
  }
  return GuidedPath{.centre = ahead.centre,
                    .acceleration_mps2 = item.advice->acceleration_mps2,
                    .lifetime_ms = lifetime_ms(item.advice->lifetime)};
}

Binding binding_of(const RsuAnswer::Item& item) {
  if (item.profile) return item.profile->binding;
  if (item.speed) return item.speed->binding;
  return item.advice ? item.advice->binding : Binding::kGuard;
}

LaneSpeed lane_word(const LaneSpeedAdvice& advice) {
  const bool known = static_cast<int>(advice.lane) < kLanes;
  return {.lane = advice.lane, .speed_mps = advice.speed_mps, .lifetime_ms = known ? lifetime_ms(advice.lifetime) : 0};
}

}  // namespace lukou
