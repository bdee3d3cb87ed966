#include "services/console/history.hpp"

#include <gtest/gtest.h>

#include "console.pb.h"

namespace lukou::console {
namespace {

TEST(Past, KeepsBothEndsOfALongRunInBoundedSpace) {
  Past past;
  for (int step = 0; step < 100'000; ++step) {
    Statistics sample;
    sample.set_step(step);
    past.add(sample);
    ASSERT_LE(past.samples(), 800U);
  }
  const History history = past.message();
  ASSERT_GE(history.samples_size(), 400);
  EXPECT_EQ(history.samples(0).step(), 0);
  EXPECT_EQ(history.samples(history.samples_size() - 1).step(), 99'999);
  for (int i = 1; i < history.samples_size(); ++i) {
    ASSERT_LT(history.samples(i - 1).step(), history.samples(i).step());
  }
  // Thinned out with age: the newest stand side by side, the oldest far apart.
  const auto gap = [&](int i) { return history.samples(i + 1).step() - history.samples(i).step(); };
  EXPECT_EQ(gap(history.samples_size() - 2), 1);
  EXPECT_GT(gap(0), 100);
}

TEST(Past, KeepsTheNewestEvents) {
  Past past;
  for (int step = 0; step < 1000; ++step) {
    Event event;
    event.set_step(step);
    past.add(event);
  }
  const History history = past.message();
  ASSERT_EQ(history.events_size(), 200);
  EXPECT_EQ(history.events(0).step(), 800);
  past.clear();
  EXPECT_EQ(past.message().events_size(), 0);
}

}  // namespace
}  // namespace lukou::console
