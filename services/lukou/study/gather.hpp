#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/results/manifest.hpp"
#include "services/lukou/study/series.hpp"
#include "services/lukou/study/study_folder.hpp"

namespace lukou::studies {

/// What a run has left behind. Facts of the wall clock are not among it.
struct RunRecord {
  enum class State : std::uint8_t { kMissing, kDone, kAnomaly, kFailed };

  RunKey key;
  State state = State::kMissing;
  int exit_code = 0;
  std::string what;  ///< why it failed
  // Of a run that is done or ended by an anomaly:
  results::Manifest manifest;
  double simulated_s = 0.0;
  double warmup_s = 0.0;
  double arrived = 0.0;                       ///< cars since step 0
  double left = 0.0;                          ///< of these
  std::vector<std::optional<double>> values;  ///< by measure of the study
  RunSeries series;

  [[nodiscard]] bool has_result() const { return state == State::kDone || state == State::kAnomaly; }
};
/// "done", "anomaly", "failed", "missing"
std::string_view name(RunRecord::State state);

/// summary.json of a result folder.
Expected<nlohmann::ordered_json> read_summary(const std::filesystem::path& result);
/// What the measures are in a run with this summary; the settling time is of its series.
std::vector<std::optional<double>> values_of(const RunRecord& run, const nlohmann::ordered_json& summary,
                                             const std::vector<std::string>& measures);

/// The runs of a study, point after point, seed after seed.
struct Gathered {
  std::vector<std::vector<RunRecord>> points;

  [[nodiscard]] std::size_t count(RunRecord::State state) const;
};

/// Every run that the study asks for, read from its folder. With a precision, what it asks for follows from the results
/// in hand: the same results always ask for the same runs, in whatever order they were made.
Expected<Gathered> gather(const StudyFolder& folder);

/// How many seeds every point needs, by point. `value`: of the precision's measure in a run; none if that run is not
/// done yet, or failed. Where runs are missing the answer is what has to be done first.
using ValueOfRun = std::function<std::optional<double>(const RunKey& run)>;
std::vector<std::uint32_t> seeds_wanted(const Study& study, const Plan& plan, const ValueOfRun& value);

/// Of these the runs without a result, seed after seed.
std::vector<RunKey> missing_runs(const Gathered& gathered);

}  // namespace lukou::studies
