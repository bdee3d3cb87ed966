#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/core/expected.hpp"

namespace lukou::report {

/// What `lukou why` is asked.
struct WhyQuestion {
  std::filesystem::path folder;
  bool guidance = false;                 ///< fates of advice instead of causes of stops
  bool list = false;                     ///< every stop, not the totals alone
  std::string cause;                     ///< only this cause or fate; empty: all
  std::optional<std::uint32_t> vehicle;  ///< only this vehicle
  bool json = false;                     ///< one JSON object
};

/// Answers on standard output, from stops.csv or guidance.csv; memory does not grow with the table unless a list is
/// asked for as JSON. Errors: no such folder, no such table, a table that is none of ours.
Expected<Done> answer_why(const WhyQuestion& question);

}  // namespace lukou::report
