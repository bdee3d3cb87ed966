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

TEST(TimeMarks, OfAClockThatIsWrongAreShiftedAndWrapWithTheMinute) {
  EXPECT_EQ(second_mark_ms(10, 0.0), 1000);
  EXPECT_EQ(second_mark_ms(10, 3.4), 1003);
  EXPECT_EQ(second_mark_ms(10, -3.6), 996);
  EXPECT_EQ(second_mark_ms(599, 250.0), 150);  // 59.9 s and a quarter of a second
  EXPECT_EQ(second_mark_ms(600, -1.0), 59'999);
  EXPECT_EQ(second_mark_ms(0, -120'000.0), 0);  // two minutes behind
}

TEST(TimeMarks, OfTheNearFutureAreTakenForWhatTheySay) {
  constexpr Step kAhead = 10;
  for (const Step now : {0, 1, 595, 599, 600, 605, 12'345}) {
    for (const double ahead_ms : {-900.0, -49.0, 0.0, 49.0, 300.0, 1000.0}) {
      const auto whole = static_cast<Step>(ahead_ms < 0.0 ? (ahead_ms - 50.0) / 100.0 : (ahead_ms + 50.0) / 100.0);
      EXPECT_EQ(step_near_second_mark(now, second_mark_ms(now, ahead_ms), kAhead), now + whole)
          << now << " " << ahead_ms;
    }
  }
  // A mark that is farther ahead can only be one of the minute before.
  EXPECT_EQ(step_near_second_mark(1000, second_mark_ms(1000, 1100.0), kAhead), 1011 - 600);
}

TEST(TimeMarks, OfARightClockMeanTheSameToBothReadings) {
  for (Step now = 0; now < 1300; now += 7) {
    for (Step made = now; made >= 0 && made > now - 500; made -= 13) {
      EXPECT_EQ(step_near_second_mark(now, second_mark_ms(made), 10), step_of_second_mark(now, second_mark_ms(made)));
    }
  }
}

}  // namespace
}  // namespace lukou
