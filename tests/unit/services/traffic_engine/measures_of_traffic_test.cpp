#include <gtest/gtest.h>

#include <cmath>

#include "common/intersection/signal_plan.hpp"
#include "common/measures/run_measures.hpp"
#include "services/traffic_engine/model/engine.hpp"
#include "services/traffic_engine/traffic_report.hpp"

// The measures on real traffic: what the tables say must agree with the sums over cars.

namespace lukou {
namespace {

TEST(MeasuresOfTraffic, AddUpToTheSumsOverCars) {
  traffic::EngineParameters parameters;
  parameters.equipped_ratio = 0.0;
  for (auto& demand : parameters.demand) {
    demand.flows = {{.from_s = 0.0, .flow_veh_per_h = 1800.0}, {.from_s = 1000.0, .flow_veh_per_h = 0.0}};
  }
  traffic::Engine engine(parameters);
  RunMeasures measures(MeasureParameters{.warmup_s = 0.0});
  const SignalPlan plan = paper_plan();
  TrafficBatch batch;
  std::uint64_t cars = 0;
  std::uint64_t stops = 0;
  double stop_time_s = 0.0;
  double delta_s = 0.0;
  for (Step k = 0; k <= 12000; ++k) {  // until everybody has left
    Heads heads{};
    for (int i = 0; i < kLanes; ++i) heads[index(Lane(i))] = aspect_at(plan, Lane(i), k - 1);
    engine.step(k, heads, {});
    report(engine, k, batch);
    measures.add(batch);
    for (const FinishedCar& car : measures.finished()) {
      ++cars;
      stops += car.stops;
      stop_time_s += static_cast<double>(car.standing_steps) / 10.0;
      delta_s += car.delta_s;
      ASSERT_EQ(car.stops == 0, car.standing_steps == 0);
      ASSERT_GT(car.delay_s, -1.0);  // noise alone may win a little
    }
  }
  LaneTotals sum;
  for (const LaneTotals& lane : measures.lanes()) {
    sum.stops += lane.stops, sum.crossed += lane.crossed, sum.standing_steps += lane.standing_steps;
    EXPECT_EQ(lane.standing_now, 0U);
  }
  const RunFigures figures = measures.figures();
  EXPECT_EQ(cars, figures.all.vehicles_arrived);
  EXPECT_EQ(cars, figures.all.vehicles_left);
  EXPECT_EQ(cars, sum.crossed);
  EXPECT_EQ(stops, sum.stops);
  EXPECT_NEAR(stop_time_s, sum.stop_time_s(), 1e-6);
  EXPECT_NEAR(*figures.all.mean_stop_time_s, stop_time_s / static_cast<double>(cars), 1e-9);
  EXPECT_NEAR(*figures.all.mean_delta_s, delta_s / static_cast<double>(cars), 1e-9);
  EXPECT_EQ(figures.collisions, 0U);
  EXPECT_EQ(figures.reversals, 0U);
  EXPECT_NEAR(static_cast<double>(cars), 2000.0, 4.0 * std::sqrt(2000.0));
}

}  // namespace
}  // namespace lukou
