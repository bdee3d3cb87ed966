#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"

namespace lukou::report {

/// Something in the life of a car, or a stretch of it.
struct StoryLine {
  Step from = 0;
  Step to = 0;       ///< the same as `from` for what happens at once
  std::string kind;  ///< "entered", "drives", "sent", "missed", "told", "stopped", "crossed", "left"
  std::string text;
};

/// What a car did, sent and was told, and why it stopped, in the order of time: from run.mcap and stops.csv. A log of
/// the level EVENTS tells of no driving and no messages of the car. Errors: no log, a broken one, no such car.
Expected<std::vector<StoryLine>> car_story(const std::filesystem::path& folder, std::uint32_t vehicle);

}  // namespace lukou::report
