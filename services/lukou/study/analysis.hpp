#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/lukou/study/gather.hpp"
#include "services/lukou/study/measure.hpp"
#include "services/lukou/study/statistics/intervals.hpp"

namespace lukou::studies {

/// What the runs of a point say.
struct PointResult {
  std::size_t runs = 0;  ///< with a result
  std::size_t anomalies = 0;
  std::size_t failed = 0;
  std::size_t missing = 0;
  double unfinished = 0.0;  ///< share of the cars that arrived and had not left at the end, mean over the runs
  std::vector<std::optional<statistics::Estimate>> measures;
  double warmup_s = 0.0;  ///< what the scenario leaves out
  /// What MSER-5 would leave out of the mean over the runs, the larger of standing cars and crossings [s]; none if the
  /// runs are too short, or have not settled.
  std::optional<double> cut_s;
};

/// An arm against the baseline in a cell, on the seeds that both have.
struct Comparison {
  std::size_t cell = 0;
  std::size_t arm = 0;
  std::size_t measure = 0;
  statistics::Estimate of_arm;
  statistics::Estimate of_baseline;
  statistics::PairedComparison paired;
  double p_holm = 1.0;       ///< corrected over the arms of the cell
  bool comparable = true;    ///< false: some run of it was ended by an anomaly, so it is over another time
  bool significant = false;  ///< comparable, p_holm below 1 - confidence, and the gain's interval leaves 0 out
  /// How much better the arm is, as a share of the baseline: positive is better, whatever the measure.
  std::optional<statistics::Estimate> gain;

  [[nodiscard]] bool better() const { return significant && gain && gain->mean > 0.0; }
  [[nodiscard]] bool worse() const { return significant && gain && gain->mean < 0.0; }
};

struct Analysis {
  std::vector<Measure> measures;
  std::vector<PointResult> points;
  std::vector<Comparison> comparisons;  ///< cell after cell, arm after arm, measure after measure

  /// None if there is no baseline, the arm is it, or no seed has both.
  [[nodiscard]] const Comparison* find(std::size_t cell, std::size_t arm, std::size_t measure) const;
};

Analysis analyse(const Study& study, const Plan& plan, const Gathered& gathered);

/// An arm against another one where both have been run, over the seeds that both have.
struct Pairs {
  std::vector<double> arm;
  std::vector<double> baseline;
  bool anomalies = false;  ///< some run among them was ended by one
};
Pairs pairs_of(const std::vector<RunRecord>& arm, const std::vector<RunRecord>& baseline, std::size_t measure);

}  // namespace lukou::studies
