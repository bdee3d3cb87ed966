#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "common/results/result_folder.hpp"
#include "services/lukou/study/database.hpp"

namespace lukou::studies {
namespace {

using statistics::Estimate;

/// A cell; in quotes where a comma or a quote would mislead.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' ? std::string("\"\"") : std::string(1, c);
  return safe + "\"";
}
/// The fewest digits that give the number back; empty if it is none.
std::string cell(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 64> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}
std::string cell(std::size_t value) { return std::to_string(value); }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : ""; }

std::string row(const std::vector<std::string>& cells) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : ",") + cells[i];
  return text + "\n";
}

/// Factors of all grids by name, each once.
std::vector<const Factor*> factors_of(const Study& study) {
  std::vector<const Factor*> factors;
  for (const Grid& grid : study.grids)
    for (const Factor& factor : grid.factors) {
      const auto same = [&](const Factor* other) { return other->name == factor.name; };
      if (std::ranges::none_of(factors, same)) factors.push_back(&factor);
    }
  return factors;
}

std::vector<std::string> columns_of_factors(const Study& study) {
  std::vector<std::string> columns;
  for (const Factor* factor : factors_of(study)) {
    columns.push_back(cell(factor->unit.empty() ? factor->name : factor->name + " [" + factor->unit + "]"));
  }
  return columns;
}

/// The point's values by factor; empty where the arm ignores one or the point is of another grid.
std::vector<std::string> cells_of_factors(const Study& study, const Point& point) {
  std::vector<std::string> cells;
  for (const Factor* factor : factors_of(study)) {
    const auto at = std::ranges::find(point.coordinates, factor->name, &Coordinate::factor);
    cells.push_back(at == point.coordinates.end() ? "" : cell(at->level.text));
  }
  return cells;
}

void append(std::vector<std::string>& cells, const std::vector<std::string>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
}

std::string runs_table(const Study& study, const Plan& plan, const Gathered& gathered) {
  std::vector<std::string> head = {"run", "arm", "seed", "state", "exit_code"};
  append(head, columns_of_factors(study));
  append(head, study.measures);
  std::string text = row(head);
  for (std::size_t p = 0; p < plan.points.size(); ++p)
    for (const RunRecord& run : gathered.points[p]) {
      const bool known = run.state != RunRecord::State::kMissing;
      std::vector<std::string> cells = {id_of(plan, run.key), cell(study.arms[plan.points[p].arm].name),
                                        std::to_string(run.key.seed), std::string(name(run.state)),
                                        known ? std::to_string(run.exit_code) : ""};
      append(cells, cells_of_factors(study, plan.points[p]));
      for (std::size_t m = 0; m < study.measures.size(); ++m) {
        cells.push_back(run.has_result() ? cell(run.values[m]) : std::string());
      }
      text += row(cells);
    }
  return text;
}

std::string estimates_table(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<std::string> head = {"point", "arm"};
  append(head, columns_of_factors(study));
  append(head, {"measure", "n", "mean", "deviation", "half_width"});
  std::string text = row(head);
  for (std::size_t p = 0; p < plan.points.size(); ++p)
    for (std::size_t m = 0; m < study.measures.size(); ++m) {
      const auto& found = analysis.points[p].measures[m];
      if (!found) continue;
      std::vector<std::string> cells = {plan.points[p].id, cell(study.arms[plan.points[p].arm].name)};
      append(cells, cells_of_factors(study, plan.points[p]));
      append(cells,
             {study.measures[m], cell(found->n), cell(found->mean), cell(found->deviation), cell(found->half_width)});
      text += row(cells);
    }
  return text;
}

std::string comparisons_table(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<std::string> head = {"grid", "cell"};
  append(head, columns_of_factors(study));
  append(head, {"arm", "measure", "n", "arm_mean", "baseline_mean", "difference", "difference_half_width", "p",
                "p_holm", "comparable", "significant", "gain", "gain_half_width", "correlation", "variance_gain"});
  std::string text = row(head);
  for (const Comparison& found : analysis.comparisons) {
    const Cell& at = plan.cells[found.cell];
    std::vector<std::string> cells = {cell(study.grids[at.grid].name), cell(found.cell)};
    append(cells, cells_of_factors(study, plan.points[at.points[found.arm]]));
    append(cells, {cell(study.arms[found.arm].name), study.measures[found.measure], cell(found.paired.difference.n),
                   cell(found.of_arm.mean), cell(found.of_baseline.mean), cell(found.paired.difference.mean),
                   cell(found.paired.difference.half_width), cell(found.paired.p), cell(found.p_holm),
                   found.comparable ? "1" : "0", found.significant ? "1" : "0",
                   found.gain ? cell(found.gain->mean) : "", found.gain ? cell(found.gain->half_width) : "",
                   cell(found.paired.correlation), cell(found.paired.variance_gain)});
    text += row(cells);
  }
  return text;
}

/// What the run's manifest says of each of its files, kept or not, as sha256sum prints it.
std::string hash_list(const Plan& plan, const Gathered& gathered) {
  std::string text;
  for (const auto& runs : gathered.points)
    for (const RunRecord& run : runs)
      for (const results::FileEntry& file : run.manifest.files) {
        text += file.sha256 + "  runs/" + id_of(plan, run.key) + "/result/" + file.name + "\n";
      }
  return text;
}

}  // namespace

Expected<Done> write_tables(const StudyFolder& folder, const Outcome& outcome) {
  const Study& study = folder.study();
  const Plan& plan = folder.plan();
  const std::vector<std::pair<const char*, std::string>> files = {
      {"runs.csv", runs_table(study, plan, outcome.gathered)},
      {"estimates.csv", estimates_table(study, plan, outcome.analysis)},
      {"comparisons.csv", comparisons_table(study, plan, outcome.analysis)},
      {"sha256.txt", hash_list(plan, outcome.gathered)}};
  for (const auto& [name, content] : files)
    if (auto done = results::write_file(folder.path() / name, content); !done) return done;
  return Done{};
}

}  // namespace lukou::studies
