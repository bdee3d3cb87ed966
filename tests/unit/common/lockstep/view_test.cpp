#include <gtest/gtest.h>

#include "common/lockstep/messages.hpp"

namespace lukou {
namespace {

View empty_road() {
  View view;
  FigureColumns& f = view.figures;
  for (auto* column : {&f.arrived, &f.waiting, &f.in_system, &f.left, &f.standing, &f.stops}) column->resize(3);
  for (auto* column :
       {&f.throughput_veh_per_h, &f.stops_per_vehicle, &f.stop_time_s, &f.mean_stop_time_s, &f.mean_delay_s}) {
    column->resize(3);
  }
  view.queue.resize(12);
  view.arrived.resize(4);
  view.waiting.resize(4);
  return view;
}

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
}

}  // namespace
}  // namespace lukou
