#include "common/radio/stations.hpp"

#include <gtest/gtest.h>

#include <map>

namespace lukou {
namespace {

TEST(Reservations, LastFiveToFifteenStepsByATriangularLaw) {
  Stations stations(4, 0.0);
  std::map<Step, int> lengths;
  int all = 0;
  for (std::uint64_t station = 1; station <= 200; ++station) {
    Step at = stations.reservation(station, 0).to;
    for (int n = 0; n < 100; ++n, ++all) {
      const Reservation now = stations.reservation(station, at);
      ASSERT_EQ(now.from, at);
      ++lengths[now.to - now.from];
      at = now.to;
    }
  }
  // The difference of two uniform delays of 0 ... 5: 10 + k steps with probability (6 - |k|) / 36. Neighbours share a
  // delay; the deviation of a share is below 0.004 for n = 20,000.
  ASSERT_EQ(lengths.begin()->first, 5);
  ASSERT_EQ(lengths.rbegin()->first, 15);
  for (const auto& [length, count] : lengths) {
    const double share = (6.0 - static_cast<double>(length < 10 ? 10 - length : length - 10)) / 36.0;
    EXPECT_NEAR(static_cast<double>(count) / all, share, 4 * 0.004) << length;
  }
}

TEST(Reservations, OfDifferentStationsDoNotEndTogether) {
  Stations stations(4, 0.0);
  std::map<Step, int> ends;
  for (std::uint64_t station = 1; station <= 5000; ++station) ++ends[stations.reservation(station, 1000).to - 1000];
  // If the grids lie at random a reservation ends k steps later with probability P(length >= k) / 10, and with the law
  // above 36 P(length >= k) is 36 up to k = 5, then 35, 33, 30, 26, 21, 15, 10, 6, 3, 1. Deviations are below 0.0043.
  const int longer[] = {36, 36, 36, 36, 36, 35, 33, 30, 26, 21, 15, 10, 6, 3, 1};
  for (Step k = 1; k <= 15; ++k) EXPECT_NEAR(ends[k] / 5000.0, longer[k - 1] / 360.0, 4 * 0.0043) << k;
}

TEST(Reservations, KeepTheirNumberAsOftenAsTheyAreTold) {
  Stations stations(4, 0.8);
  int kept = 0;
  int ends = 0;
  for (std::uint64_t station = 1; station <= 100; ++station) {
    for (Step at = 500; at < 2500;) {
      const Reservation before = stations.reservation(station, at);
      at = before.to;
      kept += stations.reservation(station, at).number == before.number ? 1 : 0;
      ++ends;
    }
  }
  EXPECT_NEAR(static_cast<double>(kept) / ends, 0.8, 4 * 0.003);  // sqrt(0.16 / 20,000)
}

TEST(Reservations, AnswerTheSameInWhateverOrderTheyAreAsked) {
  Stations one(4, 0.5);
  Stations other(4, 0.5);
  std::vector<std::uint32_t> numbers;
  for (Step at = 0; at < 300; ++at)
    for (std::uint64_t station = 0; station < 5; ++station) {
      // 1024 apart: they take each other's place in the table.
      numbers.push_back(one.reservation(station * 1024, at).number);
      numbers.push_back(one.subframe(station * 1024, at, 2));
    }
  for (Step at = 299; at >= 0; --at)
    for (std::uint64_t station = 5; station-- > 0;) {
      ASSERT_EQ(other.subframe(station * 1024, at, 2), numbers.back());
      numbers.pop_back();
      ASSERT_EQ(other.reservation(station * 1024, at).number, numbers.back());
      numbers.pop_back();
    }
}

TEST(Subframes, StayForAReservationAndAreUniform) {
  Stations stations(4, 0.0);
  int first_quarter = 0;
  for (std::uint64_t station = 1; station <= 10'000; ++station) {
    const Reservation now = stations.reservation(station, 700);
    const std::uint8_t subframe = stations.subframe(station, 700, 0);
    ASSERT_LT(subframe, 100);
    EXPECT_EQ(stations.subframe(station, now.to - 1, 0), subframe);
    first_quarter += subframe < 25 ? 1 : 0;
  }
  EXPECT_NEAR(first_quarter / 10'000.0, 0.25, 4 * 0.0043);  // sqrt(0.1875 / n)
}

}  // namespace
}  // namespace lukou
