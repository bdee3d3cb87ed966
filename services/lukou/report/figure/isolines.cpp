#include "services/lukou/report/figure/isolines.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/core/contract.hpp"

namespace lukou::figure {
namespace {

/// An edge of the grid, from a corner to its right or to its upper neighbour.
struct Edge {
  std::size_t column = 0;
  std::size_t row = 0;
  bool upwards = false;

  friend auto operator<=>(const Edge&, const Edge&) = default;
};

class Tracer {
 public:
  Tracer(const Contours& grid, double level) : grid_(grid), level_(level) {
    LUKOU_EXPECT(grid.values.size() == grid.x.size() * grid.y.size());
    for (std::size_t row = 0; row + 1 < grid.y.size(); ++row)
      for (std::size_t column = 0; column + 1 < grid.x.size(); ++column) cross(column, row);
  }

  std::vector<std::vector<Point>> lines() && {
    std::vector<std::vector<Point>> lines;
    while (!next_.empty()) lines.push_back(line(start()));
    return lines;
  }

 private:
  [[nodiscard]] double value(std::size_t column, std::size_t row) const {
    return grid_.values[row * grid_.x.size() + column];
  }

  /// Notes which edges of a square the line joins.
  void cross(std::size_t column, std::size_t row) {
    const std::array<double, 4> corners = {value(column, row), value(column + 1, row), value(column + 1, row + 1),
                                           value(column, row + 1)};
    double mean = 0.0;
    std::array<bool, 4> above{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!std::isfinite(corners[i])) return;
      above[i] = corners[i] >= level_;
      mean += corners[i] / 4.0;
    }
    const std::array<Edge, 4> edges = {
        {{column, row, false}, {column + 1, row, true}, {column, row + 1, false}, {column, row, true}}};
    std::vector<Edge> cut;
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (above[i] != above[(i + 1) % 4]) cut.push_back(edges[i]);
    if (cut.size() == 2) join(cut[0], cut[1]);
    if (cut.size() != 4) return;
    // A saddle: its middle decides which corners hang together.
    const bool first_corner_apart = above[0] != (mean >= level_);
    join(cut[0], cut[first_corner_apart ? 3 : 1]);
    join(cut[2], cut[first_corner_apart ? 1 : 3]);
  }

  void join(const Edge& a, const Edge& b) {
    next_[a].push_back(b);
    next_[b].push_back(a);
  }

  /// The end of a line, or any edge if all lines are closed.
  [[nodiscard]] Edge start() const {
    for (const auto& [edge, others] : next_)
      if (others.size() == 1) return edge;
    return next_.begin()->first;
  }

  std::vector<Point> line(Edge edge) {
    std::vector<Point> points = {place(edge)};
    for (auto here = next_.find(edge); here != next_.end(); here = next_.find(edge)) {
      const Edge to = here->second.back();
      forget(edge, to);
      forget(to, edge);
      edge = to;
      points.push_back(place(edge));
    }
    return points;
  }

  void forget(const Edge& from, const Edge& to) {
    const auto here = next_.find(from);
    std::erase(here->second, to);
    if (here->second.empty()) next_.erase(here);
  }

  [[nodiscard]] Point place(const Edge& edge) const {
    const std::size_t column = edge.upwards ? edge.column : edge.column + 1;
    const std::size_t row = edge.upwards ? edge.row + 1 : edge.row;
    const double from = value(edge.column, edge.row);
    const double share = (level_ - from) / (value(column, row) - from);
    const auto between = [share](double a, double b) { return a + (b - a) * share; };
    return {between(grid_.x[edge.column], grid_.x[column]), between(grid_.y[edge.row], grid_.y[row])};
  }

  const Contours& grid_;
  double level_;
  std::map<Edge, std::vector<Edge>> next_;
};

}  // namespace

std::vector<std::vector<Point>> isolines(const Contours& contours, double level) {
  return Tracer(contours, level).lines();
}

}  // namespace lukou::figure
