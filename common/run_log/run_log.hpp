#pragma once

#include <cstdint>
#include <string>

#include "common/core/step.hpp"

namespace lukou::run_log {

inline constexpr const char* kRunLog = "run.mcap";

/// How much a run log holds; each level holds what the one before does. docs/run-log.md says what.
enum class Level : std::uint8_t { kNone, kEvents, kSecond, kFull };
/// "NONE", "EVENTS", "SECOND", "FULL".
std::string_view name(Level level);

/// What a run log says of its run before the first step.
struct Facts {
  Level level = Level::kNone;
  std::string lukou_version;
  std::string scenario;       ///< resolved, text format
  std::string scenario_hash;  ///< SHA-256 of it
  Step steps_planned = 0;
};

/// Steps of a chunk: what a reader has to uncompress to see one of them, and what a death may cost.
inline constexpr Step kChunkSteps = 20;
inline constexpr std::uint64_t kStep_ns = static_cast<std::uint64_t>(kStep_ms) * 1'000'000U;

}  // namespace lukou::run_log
