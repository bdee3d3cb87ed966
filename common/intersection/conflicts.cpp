#include "common/intersection/conflicts.hpp"

#include <array>

#include "common/intersection/geometry.hpp"

namespace lukou {
namespace {

constexpr double kCarWidth_m = 1.8;

bool paths_meet(Lane a, Lane b) {
  const RoadLengths road;
  constexpr double kSample_m = 0.5;
  for (int i = 0; i * kSample_m <= curve_length_m(a); ++i) {
    const Pose p = pose_on_path(road, a, road.approach_m + i * kSample_m);
    for (int j = 0; j * kSample_m <= curve_length_m(b); ++j) {
      const Pose q = pose_on_path(road, b, road.approach_m + j * kSample_m);
      const double dx = p.x_m - q.x_m;
      const double dy = p.y_m - q.y_m;
      if (dx * dx + dy * dy < kCarWidth_m * kCarWidth_m) return true;
    }
  }
  return false;
}

using Matrix = std::array<std::array<Conflict, kLanes>, kLanes>;

Matrix conflict_matrix() {
  Matrix matrix{};
  for (int i = 0; i < kLanes; ++i) {
    for (int j = 0; j < kLanes; ++j) {
      const auto a = static_cast<Lane>(i);
      const auto b = static_cast<Lane>(j);
      if (approach_of(a) == approach_of(b) || !paths_meet(a, b)) continue;
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
