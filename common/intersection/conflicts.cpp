#include "common/intersection/conflicts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "common/intersection/geometry.hpp"

namespace lukou {
namespace {

constexpr double kCarWidth_m = 1.8;

/// A lane's path through the junction, every half metre.
std::vector<Pose> sampled_path(Lane lane) {
  constexpr double kSample_m = 0.5;
  const RoadLengths road;
  std::vector<Pose> path;
  for (int i = 0; i * kSample_m <= curve_length_m(lane); ++i)
    path.push_back(pose_on_path(road, lane, road.approach_m + i * kSample_m));
  return path;
}

bool paths_meet(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  return std::ranges::any_of(a, [&](const Pose& p) {
    return std::ranges::any_of(b, [&](const Pose& q) {
      const double dx = p.x_m - q.x_m;
      const double dy = p.y_m - q.y_m;
      return dx * dx + dy * dy < kCarWidth_m * kCarWidth_m;
    });
  });
}

using Matrix = std::array<std::array<Conflict, kLanes>, kLanes>;

Matrix conflict_matrix() {
  Matrix matrix{};
  std::array<std::vector<Pose>, kLanes> paths;
  for (const Lane lane : kAllLanes) paths[index(lane)] = sampled_path(lane);
  for (int i = 0; i < kLanes; ++i) {
    for (int j = 0; j < kLanes; ++j) {
      const auto a = static_cast<Lane>(i);
      const auto b = static_cast<Lane>(j);
      if (approach_of(a) == approach_of(b) || !paths_meet(paths[index(a)], paths[index(b)])) continue;
      const bool opposed = (static_cast<int>(approach_of(a)) + 2) % kApproaches == static_cast<int>(approach_of(b));
      matrix[index(a)][index(b)] = opposed ? Conflict::kPermitted : Conflict::kHard;
    }
  }
  return matrix;
}

}  // namespace

Conflict conflict(Lane a, Lane b) {
  static const Matrix kMatrix = conflict_matrix();
  return kMatrix[index(a)][index(b)];
}

LaneSet hard_conflicts(Lane lane) {
  static const std::array<LaneSet, kLanes> kCrossing = [] {
    std::array<LaneSet, kLanes> crossing;
    for (const Lane a : kAllLanes) {
      for (const Lane b : kAllLanes) {
        if (conflict(a, b) == Conflict::kHard) crossing[index(a)].insert(b);
      }
    }
    return crossing;
  }();
  return kCrossing[index(lane)];
}

LaneSet hard_conflicts(LaneSet lanes) {
  LaneSet crossing;
  for (const Lane lane : lanes) crossing = crossing | hard_conflicts(lane);
  return crossing;
}

bool has_hard_conflict(LaneSet lanes) { return !(lanes & hard_conflicts(lanes)).empty(); }

std::vector<PlanConflict> conflicts_of(const SignalPlan& plan) {
  std::vector<PlanConflict> found;
  for (int i = 0; i < kLanes; ++i) {
    for (int j = i + 1; j < kLanes; ++j) {
      const auto a = static_cast<Lane>(i);
      const auto b = static_cast<Lane>(j);
      const Conflict kind = conflict(a, b);
      if (kind == Conflict::kNone) continue;
      for (Step at = plan.offset; at < plan.offset + plan.cycle; ++at) {
        if (aspect_at(plan, a, at) == Aspect::kRed || aspect_at(plan, b, at) == Aspect::kRed) continue;
        found.push_back({a, b, kind, at});
        break;
      }
    }
  }
  return found;
}

std::vector<PlanConflict> conflicts_of(const Heads& heads, Step at) {
  std::vector<PlanConflict> found;
  for (int i = 0; i < kLanes; ++i) {
    for (int j = i + 1; j < kLanes; ++j) {
      const auto a = static_cast<Lane>(i);
      const auto b = static_cast<Lane>(j);
      if (conflict(a, b) != Conflict::kHard) continue;
      if (heads[index(a)] != Aspect::kRed && heads[index(b)] != Aspect::kRed) {
        found.push_back({a, b, Conflict::kHard, at});
      }
    }
  }
  return found;
}

std::string text(const PlanConflict& conflict) {
  return std::string(name(conflict.a)) + " and " + std::string(name(conflict.b)) + " at " +
         std::to_string(conflict.at / kStepsPerSecond) + "." + std::to_string(conflict.at % kStepsPerSecond) + " s";
}

}  // namespace lukou
