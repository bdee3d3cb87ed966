#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lukou::studies {

/// The one measure that does not stand in summary.json: settling_time_s() of the run's series.
inline constexpr const char* kSettlingTime = "settling_time_s";

/// A number that a study asks for, mostly of summary.json.
struct Measure {
  std::string path;   ///< "equipped.mean_delay_s"
  std::string label;  ///< "mean delay, equipped"
  std::string unit;   ///< may be empty
  bool less_is_better = true;
};

Measure measure_of(const std::string& path);

/// Every number that a summary may hold, in its order, and the settling time.
std::vector<std::string> known_measures();
/// What a study asks for that does not say.
std::vector<std::string> default_measures();

/// None if the summary has no such number, or nothing was there to measure (null).
std::optional<double> value_of(const nlohmann::ordered_json& summary, const std::string& path);

/// "mean delay [s]"
std::string title(const Measure& measure);

}  // namespace lukou::studies
