#include "services/lukou/report/figure/colour.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace lukou::figure {
namespace {

/// Perceived lightness, roughly.
double lightness(Colour colour) { return 0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue; }

TEST(ColourScale, GetsDarkerWithTheValueIfItIsSequential) {
  const ColourScale scale{.min = 0.0, .max = 1.0};
  for (int i = 1; i <= 20; ++i) EXPECT_LT(lightness(scale.at(i / 20.0)), lightness(scale.at((i - 1) / 20.0))) << i;
}

TEST(ColourScale, IsNearlyWhiteAtZeroAndAsDeepOnBothSidesIfItIsDiverging) {
  const ColourScale scale{.kind = ColourScale::Kind::kDiverging, .min = -10.0, .max = 40.0};
  EXPECT_GT(lightness(scale.at(0.0)), 245.0);
  const Colour below = scale.at(-10.0);
  const Colour above = scale.at(10.0);
  EXPECT_GT(below.red, below.blue);
  EXPECT_GT(above.blue, above.red);
  EXPECT_NEAR(lightness(below), lightness(above), 15.0);
}

TEST(ColourScale, HasTheColourOfTheEndBeyondIt) {
  const ColourScale scale{.min = 2.0, .max = 3.0};
  EXPECT_EQ(scale.at(-5.0), scale.at(2.0));
  EXPECT_EQ(scale.at(99.0), scale.at(3.0));
}

TEST(LookOf, DiffersInColourAndInDashesUntilItBeginsAnew) {
  std::set<std::string> colours;
  std::set<std::string> dashes;
  for (int i = 0; i < 7; ++i) {
    colours.insert(hex(look_of(i).colour));
    dashes.emplace(look_of(i).dashes);
  }
  EXPECT_EQ(colours.size(), 7U);
  EXPECT_EQ(dashes.size(), 7U);
  EXPECT_EQ(look_of(7).colour, look_of(0).colour);
}

TEST(Hex, IsTheNotationOfTheWeb) { EXPECT_EQ(hex({0, 114, 178}), "#0072b2"); }

TEST(IsDark, AsksForWhiteTextWhereBlackCannotBeRead) {
  EXPECT_TRUE(is_dark({8, 72, 143}));
  EXPECT_FALSE(is_dark({253, 231, 37}));
}

}  // namespace
}  // namespace lukou::figure
