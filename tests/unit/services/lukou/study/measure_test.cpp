#include "services/lukou/study/measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lukou::studies {
namespace {

TEST(KnownMeasures, AreAllNumbersOfASummary) {
  const auto known = known_measures();
  for (const char* path :
       {"mean_delay_s", "equipped.mean_delay_s", "fuel.mean_fuel_ml", "safety.guided.ttc", "collisions",
        "advice_lost.total", "signals.requests_refused.conflict", "mean_delay_all_s"}) {
    EXPECT_NE(std::ranges::find(known, path), known.end()) << path;
  }
  for (const std::string& path : default_measures()) EXPECT_NE(std::ranges::find(known, path), known.end()) << path;
}

TEST(MeasureOf, TakesUnitAndWordsFromTheKey) {
  EXPECT_EQ(title(measure_of("mean_stop_time_s")), "mean stop time [s]");
  EXPECT_EQ(title(measure_of("equipped.mean_delay_s")), "mean delay, equipped [s]");
  EXPECT_EQ(title(measure_of("fuel.mean_fuel_ml")), "fuel per vehicle [ml]");
  EXPECT_EQ(title(measure_of("stops_per_vehicle")), "stops per vehicle");
  EXPECT_EQ(title(measure_of("mean_abs_acceleration_mps2")), "mean size of the acceleration [m/s²]");
}

TEST(MeasureOf, KnowsThatThroughputIsBetterWhenItIsMore) {
  EXPECT_FALSE(measure_of("throughput_veh_per_h").less_is_better);
  EXPECT_TRUE(measure_of("mean_delay_s").less_is_better);
}

TEST(ValueOf, FollowsThePathAndKnowsNoNull) {
  const auto summary = nlohmann::ordered_json::parse(R"({"a": 1.5, "b": {"c": 2, "d": null}})");
  EXPECT_EQ(value_of(summary, "a"), 1.5);
  EXPECT_EQ(value_of(summary, "b.c"), 2.0);
  EXPECT_FALSE(value_of(summary, "b.d"));
  EXPECT_FALSE(value_of(summary, "b"));
  EXPECT_FALSE(value_of(summary, "a.x"));
  EXPECT_FALSE(value_of(summary, "z"));
}

}  // namespace
}  // namespace lukou::studies
