#include "common/measures/stop_cause.hpp"

#include "common/core/contract.hpp"

namespace lukou {
namespace {

constexpr std::array<std::string_view, kGuidanceStates> kGuidanceNames = {
    "not_equipped", "never_advised", "in_force",       "released", "expired",
    "rsu_unheard",  "not_complied",  "past_stop_line", "reacting"};

/// By AdviceFate.
constexpr std::array<std::string_view, kAdviceFates> kFateNames = {"applied",
                                                                   "changed_limit",
                                                                   "changed_guard",
                                                                   "changed_following",
                                                                   "changed_red",
                                                                   "past_stop_line",
                                                                   "expired",
                                                                   "superseded",
                                                                   "unknown_vehicle",
                                                                   "malformed",
                                                                   "out_of_limit",
                                                                   "lost_random",
                                                                   "lost_burst",
                                                                   "lost_range",
                                                                   "stale",
                                                                   "duplicate",
                                                                   "lost_path_loss",
                                                                   "lost_collision",
                                                                   "lost_half_duplex",
                                                                   "lost_outage",
                                                                   "not_complied",
                                                                   "changed_driver",
                                                                   "late"};

/// By AdviceKind.
constexpr std::array<std::string_view, kAdviceKinds> kKindNames = {"acceleration", "profile", "speed", "lane_speed"};

/// Whether the car stopped because of the one ahead.
bool queued(const StopFacts& facts) {
  switch (facts.bound_by) {
    case BoundBy::kBlock:
      return true;
    case BoundBy::kCarAhead:
      return facts.ahead_stands || facts.guidance != GuidanceState::kInForce;
    case BoundBy::kLight:  // the place to stop lies behind the standing block
    case BoundBy::kGuard:
      return facts.ahead_stands;
    case BoundBy::kOwnWish:
    case BoundBy::kAdvice:
    case BoundBy::kLimit:
      break;
  }
  return false;
}

/// What an advice in force came to.
StopCause overridden_by(BoundBy rule) {
  switch (rule) {
    case BoundBy::kLight:
      return StopCause::kOverriddenRed;
    case BoundBy::kGuard:
      return StopCause::kOverriddenGuard;
    case BoundBy::kLimit:
      return StopCause::kOverriddenLimit;
    case BoundBy::kAdvice:
      return StopCause::kAdvised;
    case BoundBy::kOwnWish:  // the law without a car ahead
    case BoundBy::kCarAhead:
    case BoundBy::kBlock:
      break;
  }
  return StopCause::kOverriddenFollowing;
}

/// Why there is no advice in force, if a word was missed.
StopCause missed_by(AdviceFate fate) {
  switch (fate) {
    case AdviceFate::kLostBurst:
      return StopCause::kLostBurst;
    case AdviceFate::kLostRange:
      return StopCause::kLostRange;
    case AdviceFate::kLostPathLoss:
      return StopCause::kLostPathLoss;
    case AdviceFate::kLostCollision:
      return StopCause::kLostCollision;
    case AdviceFate::kLostHalfDuplex:
      return StopCause::kLostHalfDuplex;
    case AdviceFate::kLostOutage:
      return StopCause::kLostOutage;
    case AdviceFate::kLate:
      return StopCause::kLate;
    default:
      LUKOU_EXPECT(fate == AdviceFate::kLostRandom);
      return StopCause::kLostRandom;
  }
}

}  // namespace

StopCause stop_cause(const StopFacts& facts) {
  if (facts.guidance == GuidanceState::kNotEquipped) return StopCause::kUnequipped;
  if (queued(facts)) return StopCause::kQueueAhead;
  switch (facts.guidance) {
    case GuidanceState::kInForce:
      return overridden_by(facts.bound_by);
    case GuidanceState::kNotComplied:
    case GuidanceState::kReacting:
      return StopCause::kNotComplied;
    default:
      break;
  }
  if (facts.missed != kNothingMissed) return missed_by(static_cast<AdviceFate>(facts.missed));
  if (facts.guidance == GuidanceState::kRsuUnheard || facts.rsus_silent) return StopCause::kRsuUnheard;
  if (facts.guidance == GuidanceState::kExpired) return StopCause::kExpired;
  return StopCause::kRedWithoutAdvice;
}

std::string_view name(GuidanceState state) {
  const auto place = static_cast<std::size_t>(state);
  LUKOU_EXPECT(place < kGuidanceNames.size());
  return kGuidanceNames[place];
}

std::string_view name(AdviceFate fate) {
  const auto place = static_cast<std::size_t>(fate);
  LUKOU_EXPECT(place < kFateNames.size());
  return kFateNames[place];
}

std::string_view name(AdviceKind kind) {
  const auto place = static_cast<std::size_t>(kind);
  LUKOU_EXPECT(place < kKindNames.size());
  return kKindNames[place];
}

}  // namespace lukou
