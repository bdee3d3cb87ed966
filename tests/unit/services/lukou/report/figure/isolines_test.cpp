#include "services/lukou/report/figure/isolines.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lukou::figure {
namespace {

/// A grid of 0, 1, ... in both directions with the values of f.
template <class F>
Contours grid(int columns, int rows, F f) {
  Contours grid;
  for (int i = 0; i < columns; ++i) grid.x.push_back(i);
  for (int j = 0; j < rows; ++j) grid.y.push_back(j);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) grid.values.push_back(f(static_cast<double>(i), static_cast<double>(j)));
  return grid;
}

TEST(Isolines, OfAPlaneAreOneStraightLineFromEdgeToEdge) {
  const auto lines = isolines(grid(4, 3, [](double x, double) { return 10.0 * x; }), 15.0);
  ASSERT_EQ(lines.size(), 1U);
  for (const Point& point : lines[0]) EXPECT_DOUBLE_EQ(point.x, 1.5);
  EXPECT_DOUBLE_EQ(std::abs(lines[0].back().y - lines[0].front().y), 2.0);
}

TEST(Isolines, AroundAPeakAreClosed) {
  const auto lines = isolines(grid(3, 3, [](double x, double y) { return x == 1.0 && y == 1.0 ? 4.0 : 0.0; }), 1.0);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].size(), 5U);
  EXPECT_DOUBLE_EQ(lines[0].front().x, lines[0].back().x);
  EXPECT_DOUBLE_EQ(lines[0].front().y, lines[0].back().y);
  // A quarter of the way from 0 to 4 lies three quarters of a square away from the peak.
  for (const Point& point : lines[0]) EXPECT_DOUBLE_EQ(std::abs(point.x - 1.0) + std::abs(point.y - 1.0), 0.75);
}

TEST(Isolines, DoNotCrossInASaddle) {
  // High in two opposite corners; in the middle 2: above 1, so the high corners hang together.
  const auto joined = isolines(grid(2, 2, [](double x, double y) { return x == y ? 4.0 : 0.0; }), 1.0);
  ASSERT_EQ(joined.size(), 2U);
  for (const auto& line : joined) {
    ASSERT_EQ(line.size(), 2U);
    // Each cuts off a low corner: (1, 0) or (0, 1).
    const double low_x = line[0].x + line[1].x > 1.0 ? 1.0 : 0.0;
    for (const Point& point : line)
      EXPECT_LE(std::abs(point.x - low_x) + std::abs(point.y - (1.0 - low_x)), 0.25 + 1e-12);
  }
}

TEST(Isolines, KeepAwayFromHoles) {
  const double hole = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(isolines(grid(2, 2, [&](double x, double y) { return x + y > 1.0 ? hole : x; }), 0.5).empty());
}

TEST(Isolines, AreNoneWhereTheLevelIsNotReached) {
  EXPECT_TRUE(isolines(grid(3, 3, [](double x, double y) { return x + y; }), 9.0).empty());
}

}  // namespace
}  // namespace lukou::figure
