#include "common/radio/inbox.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lukou {
namespace {

Reception heard(double at_ms, Step due) { return {.lost = {}, .first = {.due = due, .at_ms = at_ms}, .second = {}}; }

Hop from(std::uint64_t sender, std::uint32_t sequence) { return {.sender = sender, .sequence = sequence}; }

std::string taken(Inbox<char>& inbox, Step now) {
  std::string text;
  for (const auto& item : inbox.take(now))
    text += item.duplicate ? std::string("2") + item.content : std::string(1, item.content);
  return text;
}

TEST(Inbox, GivesWhatIsDueInTheOrderOfArrivalSenderAndSequence) {
  Inbox<char> inbox;
  inbox.add(heard(190.0, 2), from(5, 0), 'e');
  inbox.add(heard(150.0, 2), from(9, 1), 'd');
  inbox.add(heard(150.0, 2), from(3, 8), 'b');
  inbox.add(heard(150.0, 2), from(3, 7), 'a');
  inbox.add(heard(150.0, 2), from(3, 8), 'c');  // the same frame for another receiver
  inbox.add(heard(210.0, 3), from(1, 0), 'f');
  EXPECT_EQ(taken(inbox, 1), "");
  EXPECT_EQ(taken(inbox, 2), "abcde");
  EXPECT_EQ(taken(inbox, 2), "");
  EXPECT_EQ(taken(inbox, 3), "f");
  EXPECT_TRUE(inbox.empty());
}

TEST(Inbox, GivesADuplicateAfterItsFirst) {
  Inbox<char> inbox;
  Reception twice = heard(150.0, 2);
  twice.second = Arrival{.due = 4, .at_ms = 320.0};
  inbox.add(twice, from(1, 0), 'a');
  EXPECT_EQ(taken(inbox, 2), "a");
  EXPECT_EQ(taken(inbox, 3), "");
  EXPECT_EQ(taken(inbox, 4), "2a");
}

}  // namespace
}  // namespace lukou
