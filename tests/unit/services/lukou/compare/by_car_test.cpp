#include "services/lukou/compare/by_car.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

#include "common/scenario/scenario.hpp"

namespace lukou::compare {
namespace {

namespace fs = std::filesystem;

/// Result folders with cars by hand. The plan of `paper` has a cycle of 90 s.
class ByCar : public testing::Test {
 protected:
  ByCar() {
    fs::create_directories(folder_ / "a");
    fs::create_directories(folder_ / "b");
    const std::vector<std::string> sets = {"run.duration_s=1920", "run.warmup_s=120"};
    const auto scenario = scenario::load("paper", sets);
    EXPECT_TRUE(scenario);
    for (const char* side : {"a", "b"}) std::ofstream(folder_ / side / "scenario.textproto") << text(scenario.value());
  }
  ~ByCar() override { fs::remove_all(folder_); }

  /// A car every 10 s that stops for so long; those of `but` have not left.
  void write(const char* side, double stop_time_s, std::int64_t but = -1) const {
    std::ofstream table(folder_ / side / "car.csv");
    table << "vehicle,entered_s,stop_time_s\n";
    for (std::int64_t vehicle = 0; vehicle < 192; ++vehicle) {
      // In every other cycle everybody stops 3 s longer.
      const double wave_s = (vehicle - 12) / 9 % 2 == 0 ? 3.0 : 0.0;
      if (vehicle != but) table << vehicle << "," << vehicle * 10 << "," << stop_time_s + wave_s << "\n";
    }
  }

  fs::path folder_ = fs::temp_directory_path() / ("lukou-by-car-" + std::to_string(getpid()));
};

TEST_F(ByCar, ComparesEachCarWithItselfInBatchesOfWholeCyclesAfterTheWarmUp) {
  write("a", 5.0, 40);
  write("b", 7.0, 41);
  const auto batches = batches_of(folder_ / "a", folder_ / "b", "mean_stop_time_s");
  ASSERT_TRUE(batches) << batches.error().text();
  // 1800 s after the warm-up: 20 batches of 90 s, nine cars each, less the two that left in one of the runs only.
  EXPECT_DOUBLE_EQ(batches.value().length_s, 90.0);
  ASSERT_EQ(batches.value().pairs.arm.size(), 20U);
  EXPECT_EQ(batches.value().cars, 178U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_DOUBLE_EQ(batches.value().pairs.arm[i], i % 2 == 0 ? 8.0 : 5.0);
    EXPECT_DOUBLE_EQ(batches.value().pairs.baseline[i] - batches.value().pairs.arm[i], 2.0);
  }
  EXPECT_TRUE(batches.value().independent());
}

TEST_F(ByCar, NamesATableThatIsMissing) {
  write("a", 5.0);
  const auto batches = batches_of(folder_ / "a", folder_ / "b", "mean_stop_time_s");
  ASSERT_FALSE(batches);
  EXPECT_NE(batches.error().text().find("car.csv"), std::string::npos);
}

TEST(LagOneCorrelation, IsThatOfNeighboursAboutTheMean) {
  // About the mean 2.5: -1.5, -0.5, 0.5, 1.5; products 0.75 - 0.25 + 0.75, squares 5.
  EXPECT_DOUBLE_EQ(lag_one_correlation({1.0, 2.0, 3.0, 4.0}), 0.25);
  EXPECT_DOUBLE_EQ(lag_one_correlation({3.0, 3.0, 3.0}), 0.0);
  EXPECT_DOUBLE_EQ(lag_one_correlation({}), 0.0);
}

TEST(IsOfCars, IsTrueForWhatSingleCarsHave) {
  EXPECT_TRUE(is_of_cars("fuel.mean_fuel_ml"));
  EXPECT_FALSE(is_of_cars("throughput_veh_per_h"));
}

}  // namespace
}  // namespace lukou::compare
