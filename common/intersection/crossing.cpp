#include "common/intersection/crossing.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "common/intersection/geometry.hpp"

namespace lukou {
namespace {

constexpr double kCarWidth_m = 1.8;
constexpr double kSample_m = 0.25;

std::vector<Pose> samples(Lane lane) {
  const RoadLengths road;
  std::vector<Pose> path;
  for (int i = 0; i * kSample_m <= curve_length_m(lane); ++i) {
    path.push_back(pose_on_path(road, lane, road.approach_m + i * kSample_m));
  }
  return path;
}

bool is_near(const Pose& point, const std::vector<Pose>& path) {
  return std::ranges::any_of(path, [&](const Pose& other) {
    const double dx = point.x_m - other.x_m;
    const double dy = point.y_m - other.y_m;
    return dx * dx + dy * dy < kCarWidth_m * kCarWidth_m;
  });
}

using Areas = std::array<std::array<std::optional<CrossingArea>, kLanes>, kLanes>;

Areas all_areas() {
  std::array<std::vector<Pose>, kLanes> paths;
  for (int lane = 0; lane < kLanes; ++lane) paths[static_cast<std::size_t>(lane)] = samples(static_cast<Lane>(lane));
  Areas areas{};
  // A quarter turn maps each approach onto the next: the lanes from the west stand for all.
  for (int i = 0; i < kLanesPerApproach; ++i) {
    const auto& path = paths[static_cast<std::size_t>(i)];
    for (int j = kLanesPerApproach; j < kLanes; ++j) {
      std::optional<CrossingArea> area;
      for (std::size_t at = 0; at < path.size(); ++at) {
        if (!is_near(path[at], paths[static_cast<std::size_t>(j)])) continue;
        const double past_line_m = static_cast<double>(at) * kSample_m;
        if (!area) area = CrossingArea{past_line_m, past_line_m};
        area->to_m = past_line_m;
      }
      for (int turn = 0; turn < kApproaches; ++turn) {
        const auto rotated = [&](int lane) {
          return static_cast<std::size_t>((lane + turn * kLanesPerApproach) % kLanes);
        };
        areas[rotated(i)][rotated(j)] = area;
      }
    }
  }
  return areas;
}

}  // namespace

std::optional<CrossingArea> crossing_area(Lane lane, Lane other) {
  static const Areas kAreas = all_areas();
  return kAreas[index(lane)][index(other)];
}

}  // namespace lukou
