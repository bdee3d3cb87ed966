#include "services/lukou/study/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "services/lukou/study/statistics/warm_up.hpp"

namespace lukou::studies {
namespace {

using statistics::Estimate;

std::optional<Estimate> estimate_of(const std::vector<RunRecord>& runs, std::size_t measure, double confidence) {
  std::vector<double> values;
  for (const RunRecord& run : runs)
    if (run.has_result() && run.values[measure]) values.push_back(*run.values[measure]);
  if (values.empty()) return std::nullopt;
  return statistics::estimate(values, confidence);
}

/// The larger cut of the two series; none if one has not settled.
std::optional<double> cut_of(const std::vector<RunRecord>& runs) {
  std::vector<statistics::Series> standing;
  std::vector<statistics::Series> crossed;
  double interval_s = 0.0;
  for (const RunRecord& run : runs) {
    if (run.state != RunRecord::State::kDone) continue;  // an anomaly cuts the series short
    standing.push_back(run.series.standing_veh);
    crossed.push_back(run.series.crossed_veh);
    interval_s = run.series.interval_s;
  }
  if (standing.empty()) return std::nullopt;
  const auto a = statistics::mser5(statistics::mean_over_replications(standing));
  const auto b = statistics::mser5(statistics::mean_over_replications(crossed));
  if (!a.settled || !b.settled) return std::nullopt;
  return static_cast<double>(std::max(a.observations, b.observations)) * interval_s;
}

PointResult result_of(const Study& study, const std::vector<RunRecord>& runs) {
  PointResult result;
  for (const RunRecord& run : runs) {
    result.anomalies += run.state == RunRecord::State::kAnomaly ? 1 : 0;
    result.failed += run.state == RunRecord::State::kFailed ? 1 : 0;
    result.missing += run.state == RunRecord::State::kMissing ? 1 : 0;
    if (!run.has_result()) continue;
    ++result.runs;
    result.warmup_s = run.warmup_s;
    if (run.arrived > 0.0) result.unfinished += 1.0 - run.left / run.arrived;
  }
  if (result.runs > 0) result.unfinished /= static_cast<double>(result.runs);
  for (std::size_t m = 0; m < study.measures.size(); ++m) {
    result.measures.push_back(estimate_of(runs, m, study.confidence));
  }
  result.cut_s = cut_of(runs);
  return result;
}

Comparison compared(const Pairs& pairs, const Measure& measure, double confidence) {
  Comparison found;
  found.of_arm = statistics::estimate(pairs.arm, confidence);
  found.of_baseline = statistics::estimate(pairs.baseline, confidence);
  found.paired = statistics::compare(pairs.arm, pairs.baseline, confidence);
  found.comparable = !pairs.anomalies;
  found.gain = found.paired.reduction;
  if (found.gain && !measure.less_is_better) found.gain->mean = -found.gain->mean;
  return found;
}

/// Whether the interval of the gain leaves 0 out; few pairs may have a clear difference and a gain that is not.
bool gain_is_clear(const Comparison& found) {
  if (!found.gain || !found.gain->half_width) return true;
  return std::abs(found.gain->mean) > *found.gain->half_width;
}

/// The arms of one cell for one measure, corrected for that they are several.
void add_comparisons(const Study& study, const Cell& cell, const Gathered& gathered, const Measure& measure,
                     std::size_t cell_number, std::size_t measure_number, std::vector<Comparison>& comparisons) {
  std::vector<Comparison> family;
  for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
    if (arm == *study.baseline || cell.points[arm] == cell.points[*study.baseline]) continue;
    const Pairs pairs =
        pairs_of(gathered.points[cell.points[arm]], gathered.points[cell.points[*study.baseline]], measure_number);
    if (pairs.arm.empty()) continue;
    Comparison found = compared(pairs, measure, study.confidence);
    found.cell = cell_number;
    found.arm = arm;
    found.measure = measure_number;
    family.push_back(std::move(found));
  }
  std::vector<double> p;
  for (const Comparison& found : family) p.push_back(found.paired.p);
  const std::vector<double> corrected = statistics::holm(p);
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i].p_holm = corrected[i];
    family[i].significant = family[i].comparable && corrected[i] < 1.0 - study.confidence && gain_is_clear(family[i]);
    comparisons.push_back(std::move(family[i]));
  }
}

std::tuple<std::size_t, std::size_t, std::size_t> place_of(const Comparison& comparison) {
  return {comparison.cell, comparison.arm, comparison.measure};
}

}  // namespace

Pairs pairs_of(const std::vector<RunRecord>& arm, const std::vector<RunRecord>& baseline, std::size_t measure) {
  Pairs pairs;
  for (const RunRecord& run : arm) {
    const auto other =
        std::ranges::find(baseline, run.key.seed, [](const RunRecord& record) { return record.key.seed; });
    if (other == baseline.end() || !run.has_result() || !other->has_result()) continue;
    if (!run.values[measure] || !other->values[measure]) continue;
    pairs.arm.push_back(*run.values[measure]);
    pairs.baseline.push_back(*other->values[measure]);
    const auto anomaly = [](const RunRecord& record) { return record.state == RunRecord::State::kAnomaly; };
    pairs.anomalies = pairs.anomalies || anomaly(run) || anomaly(*other);
  }
  return pairs;
}

const Comparison* Analysis::find(std::size_t cell, std::size_t arm, std::size_t measure) const {
  const auto at = std::ranges::lower_bound(comparisons, std::tuple(cell, arm, measure), {}, place_of);
  return at == comparisons.end() || place_of(*at) != std::tuple(cell, arm, measure) ? nullptr : &*at;
}

Analysis analyse(const Study& study, const Plan& plan, const Gathered& gathered) {
  Analysis analysis;
  for (const std::string& path : study.measures) analysis.measures.push_back(measure_of(path));
  for (const auto& runs : gathered.points) analysis.points.push_back(result_of(study, runs));
  if (!study.baseline) return analysis;
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
    for (std::size_t m = 0; m < study.measures.size(); ++m) {
      add_comparisons(study, plan.cells[c], gathered, analysis.measures[m], c, m, analysis.comparisons);
    }
  std::ranges::sort(analysis.comparisons, {}, place_of);
  return analysis;
}

}  // namespace lukou::studies
