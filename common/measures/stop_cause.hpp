#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/bus/batches.hpp"

namespace lukou {

/// Why a car came to a stop. docs/results.md defines each and says which comes first.
enum class StopCause : std::uint8_t {
  kUnequipped,
  kQueueAhead,
  kNotComplied,
  kAdvised,
  kOverriddenRed,
  kOverriddenFollowing,
  kOverriddenGuard,
  kOverriddenLimit,
  kLostRandom,
  kLostBurst,
  kLostRange,
  kLostPathLoss,
  kLostCollision,
  kLostHalfDuplex,
  kLostOutage,
  kLate,
  kExpired,
  kRsuUnheard,
  kRedWithoutAdvice,
};

/// Names of the causes in the order of their values.
inline constexpr std::array<std::string_view, 19> kStopCauseNames = {
    "unequipped",        "queue_ahead",      "not_complied", "advised",    "overridden_red", "overridden_following",
    "overridden_guard",  "overridden_limit", "lost_random",  "lost_burst", "lost_range",     "lost_path_loss",
    "lost_collision",    "lost_half_duplex", "lost_outage",  "late",       "expired",        "rsu_unheard",
    "red_without_advice"};
inline constexpr std::size_t kStopCauses = kStopCauseNames.size();
constexpr std::string_view name(StopCause cause) { return kStopCauseNames[static_cast<std::size_t>(cause)]; }

/// What is known of a car in the step in which its stop begins.
struct StopFacts {
  GuidanceState guidance = GuidanceState::kNotEquipped;
  BoundBy bound_by = BoundBy::kOwnWish;
  bool ahead_stands = false;             ///< the next car on the lane, before the line, is slower than the stop speed
  std::uint8_t missed = kNothingMissed;  ///< as in TrafficBatch
  bool rsus_silent = false;              ///< the engine hears no RSU at all
};

/// The one cause. Every combination of facts has one.
StopCause stop_cause(const StopFacts& facts);

/// Names for tables: "in_force", "lost_burst", ... Require values that stand in their enum.
std::string_view name(GuidanceState state);
std::string_view name(AdviceFate fate);
std::string_view name(AdviceKind kind);

}  // namespace lukou
