#include "services/rsu/algorithms/registry.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "services/rsu/algorithms/none.hpp"

namespace lukou {
namespace {

constexpr std::array<AlgorithmDoc, 10> kAlgorithms = {{
    {"actuated", "lights: a stage stays green while cars keep coming, sensed or heard (gap-out, max-out)",
     "stop-line actuation as in the handbooks, for example FHWA's Signal Timing Manual"},
    {"arrive_on_green", "each car to the line at speed when its turn to cross comes; late cars are left alone",
     "the guidance study, algorithm \"punctual\""},
    {"cv_phase", "lights: ends the green when that costs the cars that announce themselves the least delay",
     "phase allocation under connected vehicles, Goodall, Smith, Park 2013"},
    {"eco", "each car on the trajectory with the least integral of a^2 to its crossing time",
     "closed form of the minimum-acceleration problem; eco-approach in the literature"},
    {"glosa", "each car, as if it were alone, to the even speed d / t that takes it to the line in green",
     "green light optimal speed advice, as SUMO's device of that name"},
    {"glosa_queue", "glosa that waits for the queue to discharge and keeps a headway",
     "queue-aware GLOSA in the literature; discharge of this traffic model"},
    {"max_pressure", "lights: green for the stage with the most cars before its lines, sensed or heard",
     "Varaiya 2013, max pressure control"},
    {"none", "advises nobody: SPAT and MAP only", "the baseline of every comparison"},
    {"platoon", "groups of cars cross together, a headway apart, at one speed; split at the end of green",
     "platoon entering in the literature on vehicle-road cooperation"},
    {"speed_harmonisation", "one speed for all cars of a lane, the least that light, queue and cars ahead ask for",
     "lane coordination of T/CSAE 157"},
}};

template <class Algorithm, class Parameters>
Expected<std::unique_ptr<RsuAlgorithm>> made(const Parameters& parameters) {
  return std::unique_ptr<RsuAlgorithm>(std::make_unique<Algorithm>(parameters));
}

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

std::span<const AlgorithmDoc> algorithm_docs() { return kAlgorithms; }

std::vector<std::string_view> algorithm_names() {
  std::vector<std::string_view> names;
  for (const AlgorithmDoc& doc : kAlgorithms) names.push_back(doc.name);
  return names;
}

Expected<std::unique_ptr<RsuAlgorithm>> make_algorithm(std::string_view name, const AlgorithmParameters& parameters) {
  if (name == "actuated") return made<Actuated>(parameters.actuated);
  if (name == "arrive_on_green") return made<ArriveOnGreen>(parameters.arrive_on_green);
  if (name == "cv_phase") return made<CvPhase>(parameters.cv_phase);
  if (name == "eco") return made<Eco>(parameters.eco);
  if (name == "glosa") return made<Glosa>(parameters.glosa);
  if (name == "glosa_queue") return made<Glosa>(parameters.glosa_queue);
  if (name == "max_pressure") return made<MaxPressure>(parameters.max_pressure);
  if (name == "none") return std::unique_ptr<RsuAlgorithm>(std::make_unique<NoGuidance>());
  if (name == "platoon") return made<Platoon>(parameters.platoon);
  if (name == "speed_harmonisation") return made<SpeedHarmonisation>(parameters.speed_harmonisation);
  return unknown_algorithm(name);
}

}  // namespace lukou
