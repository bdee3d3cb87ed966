#include "services/rsu/algorithms/registry.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "services/rsu/algorithms/none.hpp"

namespace lukou {
namespace {

/// Insertions, deletions and replacements that lead from one word to the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

Error unknown_algorithm(std::string_view name) {
  std::string known;
  std::string_view nearest;
  std::size_t nearest_edits = 4;  // farther away it is no slip of the finger
  for (const std::string_view candidate : algorithm_names()) {
    if (!known.empty()) known += ", ";
    known += candidate;
    const std::size_t edits = edit_distance(name, candidate);
    if (edits < nearest_edits) {
      nearest = candidate;
      nearest_edits = edits;
    }
  }
  std::string what = "there is no algorithm \"" + std::string(name) + "\"";
  if (!nearest.empty()) what += "; did you mean \"" + std::string(nearest) + "\"?";
  return {"algorithm", what + (nearest.empty() ? "; there are: " : " There are: ") + known};
}

}  // namespace

std::vector<std::string_view> algorithm_names() { return {"arrive_on_green", "none"}; }

Expected<std::unique_ptr<RsuAlgorithm>> make_algorithm(std::string_view name, const AlgorithmParameters& parameters) {
  if (name == "arrive_on_green") {
    return std::unique_ptr<RsuAlgorithm>(std::make_unique<ArriveOnGreen>(parameters.arrive_on_green));
  }
  if (name == "none") return std::unique_ptr<RsuAlgorithm>(std::make_unique<NoGuidance>());
  return unknown_algorithm(name);
}

}  // namespace lukou
