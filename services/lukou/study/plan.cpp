#include "services/lukou/study/plan.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "services/lukou/scenario_arguments.hpp"

namespace lukou::studies {
namespace {

/// "p007"; longer only beyond a thousand points.
std::string point_id(std::size_t number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "p%03zu", number);
  return text.data();
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Point point_at(const Study& study, std::size_t arm, const Grid& grid, const std::vector<std::size_t>& levels) {
  Point point{.arm = arm, .coordinates = {}, .id = {}};
  for (std::size_t f = 0; f < grid.factors.size(); ++f) {
    const Factor& factor = grid.factors[f];
    if (std::ranges::find(study.arms[arm].ignores, factor.name) != study.arms[arm].ignores.end()) continue;
    point.coordinates.push_back({factor.name, factor.unit, factor.levels[levels[f]]});
  }
  return point;
}

Sets sets_of(const Study& study, const Point& point) {
  Sets sets = study.sets;
  for (const Coordinate& coordinate : point.coordinates) {
    sets.insert(sets.end(), coordinate.level.sets.begin(), coordinate.level.sets.end());
  }
  const Sets& of_arm = study.arms[point.arm].sets;
  sets.insert(sets.end(), of_arm.begin(), of_arm.end());
  return sets;
}

/// What two points must share to be the same.
std::string key_of(const Study& study, const Point& point) {
  std::string key = std::to_string(point.arm);
  for (const auto& set : sets_of(study, point)) key += "\n" + set.set;
  return key;
}

/// The next combination, the last factor fastest; false after the last.
bool advance(std::vector<std::size_t>& levels, const Grid& grid) {
  for (std::size_t f = levels.size(); f-- > 0;) {
    if (++levels[f] < grid.factors[f].levels.size()) return true;
    levels[f] = 0;
  }
  return false;
}

}  // namespace

Plan plan_of(const Study& study) {
  Plan plan;
  std::map<std::string, std::size_t> known;
  for (std::size_t g = 0; g < study.grids.size(); ++g) {
    const Grid& grid = study.grids[g];
    std::vector<std::size_t> levels(grid.factors.size(), 0);
    do {
      Cell cell{.grid = g, .levels = levels, .points = {}};
      for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
        Point point = point_at(study, arm, grid, levels);
        const auto [place, fresh] = known.emplace(key_of(study, point), plan.points.size());
        cell.points.push_back(place->second);
        if (!fresh) continue;
        point.id = point_id(plan.points.size());
        plan.points.push_back(std::move(point));
      }
      plan.cells.push_back(std::move(cell));
    } while (advance(levels, grid));
  }
  return plan;
}

std::size_t cell_at(const Study& study, std::size_t grid, const std::vector<std::size_t>& levels) {
  const auto cells_of = [](const Grid& of) {
    std::size_t cells = 1;
    for (const Factor& factor : of.factors) cells *= factor.levels.size();
    return cells;
  };
  std::size_t before = 0;
  for (std::size_t g = 0; g < grid; ++g) before += cells_of(study.grids[g]);
  std::size_t within = 0;
  for (std::size_t f = 0; f < levels.size(); ++f) {
    within = within * study.grids[grid].factors[f].levels.size() + levels[f];
  }
  return before + within;
}

Expected<scenario::Resolved> scenario_of(const Study& study, const Point& point, std::uint64_t seed) {
  Sets sets = sets_of(study, point);
  const std::string of_seed = "run.seed=" + std::to_string(seed);
  sets.push_back({of_seed, of_seed});
  auto scenario = scenario::load_text(study.base_text, study.base_origin, study.base_directory, sets);
  if (!scenario) return scenario;
  if (auto done = check_algorithms(scenario.value()); !done) return done.error();
  return scenario;
}

std::string id_of(const Plan& plan, const RunKey& run) {
  return plan.points[run.point].id + "-s" + std::to_string(run.seed);
}

std::vector<RunKey> runs_of(const Study& study, const Plan& plan, std::uint32_t seeds) {
  std::vector<RunKey> runs;
  for (std::uint32_t i = 0; i < seeds; ++i)
    for (std::size_t point = 0; point < plan.points.size(); ++point) {
      runs.push_back({point, std::uint64_t{study.first_seed} + i});
    }
  return runs;
}

std::string text(const Factor& factor, std::size_t level) {
  return factor.name + " " + with_unit(factor.levels[level].text, factor.unit);
}

std::string text(const Study& study, const Cell& cell) {
  std::vector<std::string> words;
  const Grid& grid = study.grids[cell.grid];
  for (std::size_t f = 0; f < grid.factors.size(); ++f) words.push_back(text(grid.factors[f], cell.levels[f]));
  return joined(words);
}

std::string text(const Study& study, const Point& point) {
  std::vector<std::string> words;
  for (const Coordinate& at : point.coordinates) words.push_back(at.factor + " " + with_unit(at.level.text, at.unit));
  const std::string& arm = study.arms[point.arm].name;
  return words.empty() ? arm : arm + " at " + joined(words);
}

}  // namespace lukou::studies
