#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/lukou/study/study.hpp"

namespace lukou::studies {

/// A value of a factor that holds at a point.
struct Coordinate {
  std::string factor;
  std::string unit;
  Level level;
};

/// An arm under certain values of the factors: what is run with every seed.
struct Point {
  std::size_t arm = 0;
  std::vector<Coordinate> coordinates;  ///< without the factors that the arm ignores

  /// "p017": names its runs.
  std::string id;
};

/// One combination of the values of a grid's factors, and where each arm stands there. Cells share the points of an arm
/// that ignores what they differ in.
struct Cell {
  std::size_t grid = 0;
  std::vector<std::size_t> levels;  ///< by factor
  std::vector<std::size_t> points;  ///< by arm
};

struct Plan {
  std::vector<Point> points;
  std::vector<Cell> cells;  ///< grid after grid, the last factor fastest
};

/// Everything that a study asks for, but for the seeds.
Plan plan_of(const Study& study);

/// Number of the cell of a grid at these levels, by factor.
std::size_t cell_at(const Study& study, std::size_t grid, const std::vector<std::size_t>& levels);

/// The scenario of a point with a seed, or what is wrong with it.
Expected<scenario::Resolved> scenario_of(const Study& study, const Point& point, std::uint64_t seed);

/// A run of a study.
struct RunKey {
  std::size_t point = 0;
  std::uint64_t seed = 0;

  friend auto operator<=>(const RunKey&, const RunKey&) = default;
};
/// "p017-s3"
std::string id_of(const Plan& plan, const RunKey& run);

/// The runs with the first `seeds` seeds at every point, seed after seed, so that a study that is not finished says
/// something of every point.
std::vector<RunKey> runs_of(const Study& study, const Plan& plan, std::uint32_t seeds);

/// "latency 200 ms, lifetime 0.5 s"; "" without factors.
std::string text(const Study& study, const Cell& cell);
/// "arrive_on_green at latency 200 ms, lifetime 0.5 s"
std::string text(const Study& study, const Point& point);

}  // namespace lukou::studies
