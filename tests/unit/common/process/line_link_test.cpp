#include "common/process/line_link.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lukou::process {
namespace {

using Lines = std::vector<std::string>;

TEST(LineLink, CarriesLinesBothWays) {
  auto ends = LineLink::pair();
  ASSERT_TRUE(ends.ok());
  LineLink& ours = ends.value().first;
  LineLink theirs(ends.value().second);
  ours.say("run paper-1 3");
  ours.say("end");
  EXPECT_EQ(theirs.take(), (Lines{"run paper-1 3", "end"}));
  EXPECT_EQ(theirs.take(), Lines{}) << "each once";
  theirs.say("viewers 2");
  EXPECT_EQ(ours.take(), Lines{"viewers 2"});
}

TEST(LineLink, WaitsForTheEndOfALine) {
  auto ends = LineLink::pair();
  ASSERT_TRUE(ends.ok());
  const int theirs = ends.value().second;
  ASSERT_EQ(::send(theirs, "view", 4, 0), 4);
  EXPECT_EQ(ends.value().first.take(), Lines{});
  ASSERT_EQ(::send(theirs, "ers 1\n", 6, 0), 6);
  EXPECT_EQ(ends.value().first.take(), Lines{"viewers 1"});
  ::close(theirs);
}

TEST(LineLink, NoticesThatTheOtherEndIsGoneAfterItsLastWords) {
  auto ends = LineLink::pair();
  ASSERT_TRUE(ends.ok());
  LineLink& ours = ends.value().first;
  {
    LineLink theirs(ends.value().second);
    theirs.say("viewers 0");
  }
  EXPECT_TRUE(ours.open());
  EXPECT_EQ(ours.take(), Lines{"viewers 0"});
  EXPECT_FALSE(ours.open());
  ours.say("nobody hears it");
}

TEST(LineLink, GivesUpOnAnEndThatDoesNotReadInPlaceOfWaiting) {
  auto ends = LineLink::pair();
  ASSERT_TRUE(ends.ok());
  LineLink& ours = ends.value().first;
  const LineLink theirs(ends.value().second);
  const std::string line(1000, 'x');
  for (int i = 0; i < 100'000 && ours.open(); ++i) ours.say(line);
  EXPECT_FALSE(ours.open());
}

}  // namespace
}  // namespace lukou::process
