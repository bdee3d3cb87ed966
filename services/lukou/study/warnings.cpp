#include <algorithm>
#include <cmath>
#include <map>

#include "services/lukou/study/findings.hpp"
#include "services/lukou/study/number_text.hpp"

namespace lukou::studies {
namespace {

std::string seconds(double value_s) { return fixed(value_s, 0) + " s"; }

void warn_of_warm_up(const Study& study, const Plan& plan, const Analysis& analysis, std::vector<Sentence>& sentences) {
  std::vector<std::size_t> unsettled;
  std::vector<std::size_t> late;
  double largest_s = 0.0;
  std::size_t judged = 0;
  for (std::size_t p = 0; p < analysis.points.size(); ++p) {
    const PointResult& point = analysis.points[p];
    if (point.runs == point.anomalies) continue;  // nobody can say
    ++judged;
    if (!point.cut_s) {
      unsettled.push_back(p);
      continue;
    }
    largest_s = std::max(largest_s, *point.cut_s);
    if (*point.cut_s > point.warmup_s) late.push_back(p);
  }
  const auto first = [&](const std::vector<std::size_t>& points) {
    return "first: " + text(study, plan.points[points.front()]);
  };
  if (!late.empty()) {
    sentences.push_back({"warm-up", "MSER-5 would leave out more than the warm-up at " + std::to_string(late.size()) +
                                        " of " + std::to_string(judged) + " points, at most " + seconds(largest_s) +
                                        " (" + first(late) + ", " + seconds(*analysis.points[late.front()].cut_s) +
                                        " of a warm-up of " + seconds(analysis.points[late.front()].warmup_s) + ")."});
  }
  if (!unsettled.empty()) {
    sentences.push_back({"warm-up", "By MSER-5 " + std::to_string(unsettled.size()) + " of " + std::to_string(judged) +
                                        " points have not settled, or are too short to tell (" + first(unsettled) +
                                        ")."});
  }
}

/// Cars that the means over finished ones do not see.
void warn_of_unfinished(const Study& study, const Plan& plan, const Analysis& analysis,
                        std::vector<Sentence>& sentences) {
  constexpr double kMany = 0.1;  // at 1800 veh/h and half an hour about 4 % are always on the road
  std::size_t points = 0;
  std::size_t worst = 0;
  for (std::size_t p = 0; p < analysis.points.size(); ++p) {
    if (analysis.points[p].unfinished <= kMany) continue;
    ++points;
    if (analysis.points[p].unfinished > analysis.points[worst].unfinished) worst = p;
  }
  if (points == 0) return;
  sentences.push_back(
      {"overload", "At " + std::to_string(points) +
                       " points more than a tenth of the cars had not left at the end, at most " +
                       fixed(100.0 * analysis.points[worst].unfinished, 0) + " % (" + text(study, plan.points[worst]) +
                       "): means over cars that crossed look better than it is; mean_delay_all_s counts "
                       "every car that arrived."});
}

void warn_of_precision(const Study& study, const Plan& plan, const Analysis& analysis,
                       std::vector<Sentence>& sentences) {
  if (!study.precision) return;
  const auto measure =
      static_cast<std::size_t>(std::ranges::find(study.measures, study.precision->measure) - study.measures.begin());
  std::size_t wide = 0;
  std::size_t first = 0;
  std::size_t needed = 0;
  for (std::size_t p = analysis.points.size(); p-- > 0;) {
    const auto& found = analysis.points[p].measures[measure];
    if (!found || !found->half_width) continue;
    if (*found->half_width <= study.precision->half_width * std::abs(found->mean)) continue;
    ++wide;
    first = p;
    const auto asks = statistics::replications_needed(*found, study.precision->half_width, study.confidence);
    needed = std::max(needed, asks.value_or(0));
  }
  if (wide == 0) return;
  sentences.push_back({"precision", std::to_string(wide) + " points have not reached the half width of " +
                                        fixed(100.0 * study.precision->half_width, 1) + " % of " +
                                        analysis.measures[measure].label +
                                        " (first: " + text(study, plan.points[first]) +
                                        "); going by these runs it takes about " + std::to_string(needed) + " seeds."});
}

void warn_of_scenarios(const Study& study, const Plan& plan, std::vector<Sentence>& sentences) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> points;  ///< by warning: how many, and the first
  std::vector<std::string> order;
  for (std::size_t p = 0; p < plan.points.size(); ++p) {
    const auto scenario = scenario_of(study, plan.points[p], study.first_seed);
    if (!scenario) continue;
    for (const std::string& warning : scenario::warnings(scenario.value())) {
      if (points.try_emplace(warning, 0, p).second) order.push_back(warning);
      ++points[warning].first;
    }
  }
  for (const std::string& warning : order) {
    const auto& [count, first] = points[warning];
    const bool all = count == plan.points.size();
    sentences.push_back(
        {"scenario",
         (all ? "All points: " : std::to_string(count) + " points (first: " + text(study, plan.points[first]) + "): ") +
             warning + "."});
  }
}

}  // namespace

std::vector<Sentence> warnings_of(const Study& study, const Plan& plan, const Gathered& gathered,
                                  const Analysis& analysis) {
  std::vector<Sentence> sentences;
  const std::size_t failed = gathered.count(RunRecord::State::kFailed);
  const std::size_t missing = gathered.count(RunRecord::State::kMissing);
  if (failed > 0) {
    sentences.push_back({"runs", std::to_string(failed) + (failed == 1 ? " run" : " runs") +
                                     " failed; their points rest on fewer seeds."});
  }
  if (missing > 0) sentences.push_back({"runs", std::to_string(missing) + " runs are missing; --resume makes them."});
  for (std::size_t p = 0; p < analysis.points.size(); ++p) {
    if (analysis.points[p].anomalies == 0) continue;
    sentences.push_back(
        {"anomaly", text(study, plan.points[p]) + ": " + std::to_string(analysis.points[p].anomalies) + " of " +
                        std::to_string(analysis.points[p].runs) +
                        " runs were ended early by an anomaly; their figures are of a shorter time, and "
                        "nothing is concluded from them."});
  }
  warn_of_unfinished(study, plan, analysis, sentences);
  warn_of_warm_up(study, plan, analysis, sentences);
  warn_of_precision(study, plan, analysis, sentences);
  warn_of_scenarios(study, plan, sentences);
  return sentences;
}

}  // namespace lukou::studies
