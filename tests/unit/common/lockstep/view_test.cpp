#include <gtest/gtest.h>

#include "tests/unit/common/lockstep/empty_road.hpp"

namespace lukou {
namespace {

TEST(View, OfAnEmptyRoadIsWellFormed) { EXPECT_TRUE(empty_road().well_formed()); }

TEST(View, IsBrokenIfAnyColumnHasAnotherLength) {
  const auto broken = [](auto change) {
    View view = empty_road();
    change(view);
    return !view.well_formed();
  };
  EXPECT_TRUE(broken([](View& v) { v = View(); }));
  EXPECT_TRUE(broken([](View& v) { v.figures.mean_delay_s.clear(); }));
  EXPECT_TRUE(broken([](View& v) { v.queue.pop_back(); }));
  EXPECT_TRUE(broken([](View& v) { v.waiting.push_back(0); }));
  EXPECT_TRUE(broken([](View& v) { v.vehicle.push_back(0); }));
  EXPECT_TRUE(broken([](View& v) { v.advice_step.push_back(0); }));
  EXPECT_TRUE(broken([](View& v) { v.uplink.push_back(0); }));
  EXPECT_TRUE(broken([](View& v) { v.heard_step.push_back(0); }));
  EXPECT_TRUE(broken([](View& v) { v.heads.resize(12); })) << "without their changes";
  EXPECT_TRUE(broken([](View& v) { v.heads.resize(5), v.change_step.resize(5), v.next_aspect.resize(5); }));
  EXPECT_TRUE(broken([](View& v) { v.radio_lost.resize(7); })) << "of no row";
  EXPECT_TRUE(broken([](View& v) { v.advice.pop_back(); }));
}

}  // namespace
}  // namespace lukou
