#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/benchmark/figures.hpp"

namespace lukou::test {

/// What a figure has to reach (`floor`) and what it should reach (`goal`); for most figures more is better.
struct Aim {
  std::optional<double> floor;
  std::optional<double> goal;
  bool less_is_better = false;
};

/// A table of measured figures beside floors and goals, printed as Markdown, row by row.
class SpeedTable {
 public:
  explicit SpeedTable(int repeats);

  /// `decimals` of the printed numbers. The last column is the way to the goal: 1 = reached.
  void row(const std::string& what, const Spread& measured, const Aim& aim, int decimals = 0);
  /// A row that could not be measured, and why.
  void gap(const std::string& what, const Aim& aim, const std::string& why, int decimals = 0);

  [[nodiscard]] bool floors_met() const { return below_.empty(); }
  /// Says which floors and goals were missed and what was not measured.
  void print_verdict() const;

 private:
  std::vector<std::string> below_;
  std::vector<std::string> short_of_goal_;
  std::vector<std::string> unmeasured_;
};

/// y = a + b x by least squares, and the share of y's variance that it explains; of at least two points.
struct Line {
  double a = 0.0;
  double b = 0.0;
  double r2 = 0.0;
};
Line fitted_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace lukou::test
