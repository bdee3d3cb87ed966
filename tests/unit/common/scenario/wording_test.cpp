#include "common/scenario/wording.hpp"

#include <gtest/gtest.h>

namespace lukou::scenario {
namespace {

TEST(Wording, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(number_text(20000.0), "20000");
  EXPECT_EQ(number_text(100000.0), "100000");
  EXPECT_EQ(number_text(0.05), "0.05");
  EXPECT_EQ(number_text(-0.1), "-0.1");
  EXPECT_EQ(number_text(0.00001), "0.00001");
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(1e300), "1e+300");
}

TEST(Wording, CountsInWords) {
  EXPECT_EQ(ordinal(1), "1st");
  EXPECT_EQ(ordinal(2), "2nd");
  EXPECT_EQ(ordinal(3), "3rd");
  EXPECT_EQ(ordinal(4), "4th");
  EXPECT_EQ(ordinal(11), "11th");
  EXPECT_EQ(ordinal(12), "12th");
  EXPECT_EQ(ordinal(21), "21st");
  EXPECT_EQ(ordinal(113), "113th");
}

TEST(Wording, SuggestsTheNearestWordOrListsThem) {
  EXPECT_EQ(nearest("wst", {"east", "west"}), "west");  // one insertion against two changes
  EXPECT_EQ(nearest("zzz", {"east", "west"}), std::nullopt);
  EXPECT_EQ(suggestion("sooth", {"west", "south"}), "; did you mean `south`?");
  EXPECT_EQ(suggestion("up", {"west", "south"}), "; it has west, south");
}

}  // namespace
}  // namespace lukou::scenario
