#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/lukou/compare/side.hpp"
#include "services/lukou/study/analysis.hpp"

namespace lukou::compare {

/// What an interval rests on.
enum class Basis : std::uint8_t {
  kSeeds,    ///< pairs of runs with the same seed
  kBatches,  ///< one pair of runs: batches of its cars
  kApart,    ///< runs with different seeds: Welch's test, nothing is paired
  kNone      ///< one value on each side
};
/// "pairs of seeds", "batches of cars", "different seeds", "single runs"
std::string_view name(Basis basis);

/// A measure in a group. Differences are A less B.
struct Judgement {
  studies::Measure measure;
  Basis basis = Basis::kNone;
  studies::Comparison found;
};

/// A group of A and the group of B that it was compared with.
struct GroupJudgement {
  std::string label;
  std::vector<Judgement> measures;  ///< those that both sides have
};

struct Comparison {
  std::vector<GroupJudgement> groups;
  std::vector<std::string> warnings;  ///< what a reader has to know before the figures are believed

  /// Whether some measure differs beyond chance.
  [[nodiscard]] bool differs() const;
};

/// Compares the sides measure by measure, group by group of the same label (whatever their labels if each side has
/// one). Requires read_values() of both with these measures. Error: no group in common, or a table that cannot be read.
Expected<Comparison> compare(const Side& a, const Side& b, const std::vector<std::string>& measures, double confidence);

}  // namespace lukou::compare
