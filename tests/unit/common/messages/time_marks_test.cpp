#include "common/messages/time_marks.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(TimeMarks, CountMillisecondsWithinTheMinute) {
  EXPECT_EQ(second_mark_ms(0), 0);
  EXPECT_EQ(second_mark_ms(599), 59'900);
  EXPECT_EQ(second_mark_ms(600), 0);
  EXPECT_EQ(second_mark_ms(108'001), 100);  // 10800.1 s are 180 minutes and 0.1 s
}

TEST(TimeMarks, CountMinutesOfTheYear) {
  EXPECT_EQ(minute_of_year(599), 0U);
  EXPECT_EQ(minute_of_year(600), 1U);
  EXPECT_EQ(minute_of_year(527'040 * 600 - 1), 527'039U);
  EXPECT_EQ(minute_of_year(527'040LL * 600), 0U);
}

TEST(TimeMarks, GiveBackTheStepInWhichAMessageWasMade) {
  for (const Step made : {Step{0}, Step{599}, Step{600}, Step{1234}}) {
    EXPECT_EQ(step_of_second_mark(made, second_mark_ms(made)), made);
    EXPECT_EQ(step_of_second_mark(made + 37, second_mark_ms(made)), made);
    EXPECT_EQ(step_of_second_mark(made + 599, second_mark_ms(made)), made);
  }
}

TEST(TimeMarks, TakeAMarkBetweenStepsForTheLaterOne) { EXPECT_EQ(step_of_second_mark(20, 1901), 20); }

}  // namespace
}  // namespace lukou
