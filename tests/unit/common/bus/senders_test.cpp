#include "common/bus/senders.hpp"

#include <gtest/gtest.h>

namespace lukou::bus {
namespace {

TEST(Senders, KnowWhoseWriterItIs) {
  Senders senders;
  EXPECT_FALSE(senders.knows(7));
  EXPECT_EQ(senders.of(7), 0U);
  senders.add(7, 0xABCD);
  senders.add(8, 0x1234);
  EXPECT_TRUE(senders.knows(7));
  EXPECT_EQ(senders.of(7), 0xABCDU);
  EXPECT_EQ(senders.of(8), 0x1234U);
}

TEST(Senders, DoNotBelieveASecondWriterThatClaimsToBeTheSame) {
  Senders senders;
  senders.add(7, 0xABCD);
  senders.add(9, 0xABCD);
  EXPECT_EQ(senders.of(9), 0U);
  EXPECT_EQ(senders.of(7), 0xABCDU) << "the first one stays";
  senders.add(7, 0x9999);
  EXPECT_EQ(senders.of(7), 0xABCDU) << "what it has said once stands";
}

TEST(Senders, DoNotKnowOneThatDoesNotSayWhoItIs) {
  Senders senders;
  senders.add(7, 0);
  senders.add(8, 0);
  EXPECT_TRUE(senders.knows(7));
  EXPECT_EQ(senders.of(7), 0U);
  EXPECT_EQ(senders.of(8), 0U);
}

}  // namespace
}  // namespace lukou::bus
