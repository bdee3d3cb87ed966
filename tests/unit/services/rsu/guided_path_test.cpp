#include "services/rsu/guided_path.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/math.hpp"

namespace lukou {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

CarReport eastbound() {
  CarReport car;
  car.place = {.centre_x_m = -200.0, .centre_y_m = -5.25, .heading_rad = math::kPi / 2, .length_m = 4.5};
  car.speed_mps = 10.0;
  return car;
}

RsuAnswer::Item profile(std::vector<AccelerationSegment> segments) {
  return {.car = TemporaryId{1}, .profile = AccelerationProfile{.segments = std::move(segments)}};
}

TEST(GuidedPathOfAnAnswer, TellsWhereAProfileLeads) {
  const CarReport car = eastbound();
  const auto path = guided_path(profile({{10, 2.0}, {20, -1.0}, {5, 0.25}}), &car);
  ASSERT_TRUE(path);
  EXPECT_TRUE(fits(*path));
  EXPECT_EQ(path->acceleration_mps2, 2.0);
  EXPECT_EQ(path->lifetime_ms, 3500U);
  EXPECT_EQ(path->centre.x_m, -200.0);
  ASSERT_EQ(path->later.size(), 2U);
  EXPECT_EQ(path->later[0].from_ms, 1000U);
  EXPECT_EQ(path->later[0].acceleration_mps2, -1.0);
  EXPECT_NEAR(path->later[0].centre.x_m, -189.0, 1e-9);  // 1 s at 10 ... 12 m/s
  EXPECT_NEAR(path->later[0].centre.y_m, -5.25, 1e-9);
  EXPECT_EQ(path->later[1].from_ms, 3000U);
  EXPECT_NEAR(path->later[1].centre.x_m, -167.0, 1e-9);  // 2 s at 12 ... 10 m/s
}

TEST(GuidedPathOfAnAnswer, NeverLeadsBackwards) {
  const CarReport car = eastbound();
  const auto path = guided_path(profile({{100, -3.0}, {10, 1.0}}), &car);
  EXPECT_NEAR(path->later.at(0).centre.x_m, -150.0, 1e-9);  // stands: 10 s at 10 ... 0 m/s on average
}

TEST(GuidedPathOfAnAnswer, DoesNotFitIfNoMessageCanCarryIt) {
  const CarReport car = eastbound();
  const auto fit = [&](std::vector<AccelerationSegment> segments) {
    return fits(*guided_path(profile(std::move(segments)), &car));
  };
  EXPECT_TRUE(fit({{1, 0.0}}));
  EXPECT_TRUE(fit({{6552, 0.0}, {1, 1.0}}));
  EXPECT_FALSE(fit({}));
  EXPECT_FALSE(fit({{0, 1.0}, {5, 1.0}}));
  EXPECT_FALSE(fit({{5, 1.0}, {-1, 1.0}}));
  EXPECT_FALSE(fit({{5, 1.0}, {5, kNaN}}));
  EXPECT_FALSE(fit({{5, 20.01}}));
  EXPECT_FALSE(fit({{6553, 0.0}, {1, 1.0}}));
  EXPECT_FALSE(fit({{6553, 0.0}, {6553, 1.0}}));
  EXPECT_TRUE(fit(std::vector<AccelerationSegment>(32, {1, 0.5})));
  EXPECT_FALSE(fit(std::vector<AccelerationSegment>(33, {1, 0.5})));
}

TEST(GuidedPathOfAnAnswer, CarriesASpeedAndKeepsTheBinding) {
  RsuAnswer answer;
  answer.advise_speed(TemporaryId{1}, {.speed_mps = 12.5, .lifetime = 7, .binding = Binding::kFollowing});
  answer.release(TemporaryId{2});
  const auto path = guided_path(answer.items()[0], nullptr);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->speed_mps, 12.5);
  EXPECT_EQ(path->lifetime_ms, 700U);
  EXPECT_TRUE(fits(*path));
  EXPECT_EQ(binding_of(answer.items()[0]), Binding::kFollowing);
  EXPECT_FALSE(guided_path(answer.items()[1], nullptr));
}

TEST(LaneWord, DoesNotFitIfNoMessageCanCarryIt) {
  EXPECT_TRUE(fits(lane_word({.lane = Lane{11}, .speed_mps = 10.0, .lifetime = 5})));
  EXPECT_FALSE(fits(lane_word({.lane = Lane{12}, .speed_mps = 10.0, .lifetime = 5})));
  EXPECT_FALSE(fits(lane_word({.lane = Lane{0}, .speed_mps = -1.0, .lifetime = 5})));
  EXPECT_FALSE(fits(lane_word({.lane = Lane{0}, .speed_mps = kNaN, .lifetime = 5})));
  EXPECT_FALSE(fits(lane_word({.lane = Lane{0}, .speed_mps = 10.0, .lifetime = 6554})));
}

}  // namespace
}  // namespace lukou
