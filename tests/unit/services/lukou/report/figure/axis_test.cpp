#include "services/lukou/report/figure/axis.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lukou::figure {
namespace {

Extent extent(double min, double max) { return {min, max}; }

std::vector<std::string> texts(const AxisScale& scale) {
  std::vector<std::string> texts;
  for (const Tick& tick : scale.ticks()) texts.push_back(tick.text);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(NiceStep, IsTheLeastOfOneTwoTwoAndAHalfAndFiveThatIsNotBelow) {
  EXPECT_DOUBLE_EQ(nice_step(0.9), 1.0);
  EXPECT_DOUBLE_EQ(nice_step(1.0), 1.0);
  EXPECT_DOUBLE_EQ(nice_step(21.0), 25.0);
  EXPECT_DOUBLE_EQ(nice_step(0.03), 0.05);
  EXPECT_DOUBLE_EQ(nice_step(600.0), 1000.0);
}

TEST(TickText, HasTheDecimalsOfItsStep) {
  EXPECT_EQ(tick_text(2.0, 0.25), "2.00");
  EXPECT_EQ(tick_text(1500.0, 500.0), "1500");
  EXPECT_EQ(tick_text(0.1 + 0.2, 0.1), "0.3");
}

TEST(TickText, WritesAMinusAndNoMinusZero) {
  EXPECT_EQ(tick_text(-5.0, 5.0), "\u22125");
  EXPECT_EQ(tick_text(-1e-15, 0.1), "0.0");
}

TEST(AxisScale, WidensTheContentToTicks) {
  const AxisScale scale(Axis{}, extent(0.7, 9.2), 5);
  // A fifth of 8.5 is 1.7, so ticks come every 2.
  EXPECT_DOUBLE_EQ(scale.min(), 0.0);
  EXPECT_DOUBLE_EQ(scale.max(), 10.0);
  EXPECT_EQ(texts(scale), (Texts{"0", "2", "4", "6", "8", "10"}));
}

TEST(AxisScale, KeepsTheEndsThatTheUserSet) {
  const AxisScale scale(Axis{.min = 0.5, .max = 3.5}, extent(1.0, 2.0), 3);
  EXPECT_DOUBLE_EQ(scale.min(), 0.5);
  EXPECT_DOUBLE_EQ(scale.share(2.0), 0.5);
  EXPECT_EQ(texts(scale), (Texts{"1", "2", "3"}));
}

TEST(AxisScale, MakesRoomAroundASingleValue) {
  const AxisScale scale(Axis{}, extent(20.0, 20.0), 4);
  EXPECT_LT(scale.min(), 20.0);
  EXPECT_GT(scale.max(), 20.0);
}

TEST(AxisScale, StandsWithoutContent) {
  const AxisScale scale(Axis{}, {}, 4);
  EXPECT_LT(scale.min(), scale.max());
}

TEST(AxisScale, PlacesNamesHalfAStepFromTheEnds) {
  const AxisScale scale(Axis{.names = {"a", "b"}}, extent(0.0, 100.0), 4);
  EXPECT_DOUBLE_EQ(scale.share(0.0), 0.25);
  EXPECT_DOUBLE_EQ(scale.share(1.0), 0.75);
  EXPECT_EQ(texts(scale), (Texts{"a", "b"}));
}

TEST(AxisScale, CountsDecadesIfItIsLogarithmic) {
  const AxisScale scale(Axis{.logarithmic = true}, extent(0.02, 700.0), 6);
  EXPECT_NEAR(scale.min(), 0.01, 1e-12);
  EXPECT_NEAR(scale.max(), 1000.0, 1e-9);
  EXPECT_NEAR(scale.share(1.0), 0.4, 1e-12);  // the second of five decades ends there
  EXPECT_EQ(texts(scale), (Texts{"0.01", "0.1", "1", "10", "100", "1000"}));
}

TEST(AxisScale, HasTicksWithinAFewDecades) {
  const AxisScale scale(Axis{.logarithmic = true}, extent(120.0, 900.0), 6);
  EXPECT_EQ(texts(scale), (Texts{"100", "200", "500", "1000"}));
}

TEST(Extent, LeavesOutWhatIsNoNumber) {
  Extent found;
  found.take(std::numeric_limits<double>::quiet_NaN());
  found.take(std::numeric_limits<double>::infinity());
  EXPECT_FALSE(found.min);
  found.take(3.0);
  found.take(-1.0);
  EXPECT_DOUBLE_EQ(*found.min, -1.0);
  EXPECT_DOUBLE_EQ(*found.max, 3.0);
}

TEST(AxisTitle, HasTheUnitInBrackets) {
  EXPECT_EQ(title(Axis{.label = "latency", .unit = "ms"}), "latency [ms]");
  EXPECT_EQ(title(Axis{.label = "lane"}), "lane");
}

}  // namespace
}  // namespace lukou::figure
