#include "services/lukou/study/findings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "services/lukou/study/number_text.hpp"

namespace lukou::studies {
namespace {

using statistics::Estimate;

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// What can be said of an arm in a cell.
enum class Verdict : std::uint8_t { kBetter, kWorse, kEqual, kNone, kNotComparable };

Verdict verdict_of(const Comparison& found) {
  if (!found.comparable) return Verdict::kNotComparable;
  if (found.better()) return Verdict::kBetter;
  if (found.worse()) return Verdict::kWorse;
  const bool equal = found.paired.difference.mean == 0.0 && found.paired.difference.deviation == 0.0;
  return equal ? Verdict::kEqual : Verdict::kNone;
}

/// A stretch along the first factor with the same verdict.
struct Stretch {
  Verdict verdict{};
  std::vector<const Comparison*> cells;
  std::vector<std::string> levels;
};

/// How an arm does along the first factor, the others held.
class Line {
 public:
  Line(const Grid& grid, const Measure& measure) : grid_(grid), measure_(measure) {}

  void add(const Comparison& found, std::size_t level) {
    const Verdict verdict = verdict_of(found);
    if (stretches_.empty() || stretches_.back().verdict != verdict) stretches_.push_back({verdict, {}, {}});
    stretches_.back().cells.push_back(&found);
    stretches_.back().levels.push_back(grid_.factors.empty() ? "" : level_text(level));
    least_n_ = std::min(least_n_, found.paired.difference.n);
  }

  [[nodiscard]] bool empty() const { return stretches_.empty(); }
  /// "mean stop time falls by 85 % [84, 86] at latency 0 ms; from 900 ms on no difference can be told (n = 5)"
  [[nodiscard]] std::string text() const {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < stretches_.size(); ++i) parts.push_back(part(stretches_[i], i == 0));
    return joined(parts, "; ") + " (n = " + std::to_string(least_n_) + ")";
  }

 private:
  [[nodiscard]] std::string level_text(std::size_t level) const {
    const Factor& factor = grid_.factors.front();
    return factor.levels[level].text + (factor.unit.empty() ? "" : " " + factor.unit);
  }

  /// "at 200 ms", "from 900 ms to 2500 ms"; the first names the factor.
  [[nodiscard]] std::string where(const Stretch& stretch, bool first) const {
    if (grid_.factors.empty()) return "";
    const std::string factor = first ? grid_.factors.front().name + " " : "";
    if (stretch.levels.size() == 1) return " at " + factor + stretch.levels.front();
    if (grid_.factors.front().numeric()) {
      return " from " + factor + stretch.levels.front() + " to " + stretch.levels.back();
    }
    return " at " + factor + joined(stretch.levels, ", ");
  }

  [[nodiscard]] std::string part(const Stretch& stretch, bool first) const {
    const std::string subject = first ? measure_.label + " " : "it ";
    switch (stretch.verdict) {
      case Verdict::kEqual:
        return (first ? measure_.label + ": " : "") + "every run is equal to the baseline's to the last digit" +
               where(stretch, first);
      case Verdict::kNone:
        return (first ? measure_.label + ": " : "") + "no difference can be told" + where(stretch, first);
      case Verdict::kNotComparable:
        return (first ? measure_.label + ": " : "") + "not comparable, since an anomaly ended runs," +
               where(stretch, first);
      case Verdict::kBetter:
      case Verdict::kWorse:
        break;
    }
    const bool falls = (stretch.verdict == Verdict::kBetter) == measure_.less_is_better;
    const auto amount = [](const Comparison& found) {
      Estimate size = *found.gain;
      size.mean = std::abs(size.mean);
      return percent_text(size);
    };
    std::string text = subject + (falls ? "falls by " : "rises by ") + amount(*stretch.cells.front());
    if (stretch.cells.size() == 1) return text + where(stretch, first);
    const Stretch begin{stretch.verdict, {}, {stretch.levels.front()}};
    return text + where(begin, first) + " and by " + amount(*stretch.cells.back()) + " at " + stretch.levels.back();
  }

  const Grid& grid_;
  const Measure& measure_;
  std::vector<Stretch> stretches_;
  std::size_t least_n_ = SIZE_MAX;
};

/// Levels of all factors but the first, in words: "lifetime 0.5 s, ".
std::string others_text(const Grid& grid, const Cell& cell) {
  std::vector<std::string> words;
  for (std::size_t f = 1; f < grid.factors.size(); ++f) words.push_back(text(grid.factors[f], cell.levels[f]));
  return joined(words, ", ");
}

void add_lines(const Study& study, const Plan& plan, const Analysis& analysis, std::size_t measure, std::size_t grid,
               std::size_t arm, std::vector<Sentence>& sentences) {
  // By the levels of the other factors, in their order.
  std::map<std::vector<std::size_t>, std::pair<std::string, Line>> lines;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const Cell& cell = plan.cells[c];
    const Comparison* found = cell.grid == grid ? analysis.find(c, arm, measure) : nullptr;
    if (found == nullptr) continue;
    std::vector<std::size_t> others = cell.levels;
    if (!others.empty()) others.erase(others.begin());
    const auto at = lines.try_emplace(others, others_text(study.grids[grid], cell),
                                      Line(study.grids[grid], analysis.measures[measure]));
    at.first->second.second.add(*found, cell.levels.empty() ? 0 : cell.levels.front());
  }
  for (const auto& [levels, line] : lines) {
    std::string head = study.arms[arm].name;
    if (!line.first.empty()) head += ", " + line.first;
    sentences.push_back({analysis.measures[measure].label, head + ": " + line.second.text() + "."});
  }
}

/// Where a measure is least and most.
void add_extremes(const Study& study, const Plan& plan, const Analysis& analysis, std::size_t measure,
                  std::vector<Sentence>& sentences) {
  std::optional<std::size_t> least;
  std::optional<std::size_t> most;
  const auto at = [&](std::size_t point) -> const Estimate& { return *analysis.points[point].measures[measure]; };
  for (std::size_t p = 0; p < plan.points.size(); ++p) {
    if (!analysis.points[p].measures[measure]) continue;
    if (!least || at(p).mean < at(*least).mean) least = p;
    if (!most || at(p).mean > at(*most).mean) most = p;
  }
  if (!least) return;
  const Measure& what = analysis.measures[measure];
  const auto of = [&](std::size_t point) {
    return value_text(at(point), what.unit) + " for " + text(study, plan.points[point]);
  };
  std::string sentence = what.label + " is " + of(*least);
  if (*most != *least) sentence += ", the least, and " + of(*most) + ", the most";
  sentences.push_back({what.label, sentence + " (n = " + std::to_string(at(*least).n) + ")."});
}

/// What common random numbers have gained, over all comparisons of the first measure that has any.
void add_pairing(const Study& study, const Analysis& analysis, std::vector<Sentence>& sentences) {
  std::vector<double> gains;
  for (const Comparison& found : analysis.comparisons)
    if (found.paired.variance_gain) gains.push_back(*found.paired.variance_gain);
  if (gains.empty()) return;
  std::ranges::sort(gains);
  const double median = gains[gains.size() / 2];
  sentences.push_back({"pairing",
                       "The arms see the same arrivals: in the median over all comparisons that divides the "
                       "variance of their difference by " +
                           (median < 1000.0 ? fixed(median, median < 10.0 ? 1 : 0) : "more than 1000") + "."});
  if (study.arms.size() > 2) {
    sentences.push_back({"pairing", "Each cell compares " + std::to_string(study.arms.size() - 1) +
                                        " arms with the baseline; their p-values are corrected by Holm's method."});
  }
}

}  // namespace

std::vector<Sentence> findings_of(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<Sentence> sentences;
  for (std::size_t measure = 0; measure < analysis.measures.size(); ++measure) {
    if (!study.baseline) add_extremes(study, plan, analysis, measure, sentences);
    if (!study.baseline) continue;
    for (std::size_t grid = 0; grid < study.grids.size(); ++grid)
      for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
        add_lines(study, plan, analysis, measure, grid, arm, sentences);
      }
  }
  add_pairing(study, analysis, sentences);
  return sentences;
}

}  // namespace lukou::studies
