#include "common/results/radio_table.hpp"

#include <limits>

#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::results {
namespace {

using RadioTableIn = InTestFolder;

TEST_F(RadioTableIn, MakesNoFileWithoutARow) {
  RadioTable table(folder());
  ASSERT_TRUE(table.flush());
  ASSERT_TRUE(table.sync());
  EXPECT_FALSE(table.entry());
  EXPECT_FALSE(std::filesystem::exists(folder() / kRadioTable));
}

TEST_F(RadioTableIn, WritesARowPerSecondDirectionAndKind) {
  RadioTable table(folder());
  ASSERT_TRUE(table.add(10, {.direction = "uplink",
                             .kind = "bsm",
                             .sent = 9,
                             .heard = 5,
                             .lost_random = 1,
                             .lost_burst = 2,
                             .lost_range = 3,
                             .lost_path_loss = 11,
                             .lost_collision = 12,
                             .lost_half_duplex = 13,
                             .lost_outage = 14,
                             .duplicates = 4,
                             .latency_mean_ms = 52.25,
                             .latency_p95_ms = 95.0,
                             .latency_p99_ms = 99.5,
                             .busy_ratio = 0.25}));
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(table.add(20, {.direction = "downlink",
                             .kind = "rsc",
                             .latency_mean_ms = unknown,
                             .latency_p95_ms = unknown,
                             .latency_p99_ms = unknown,
                             .busy_ratio = unknown}));
  ASSERT_TRUE(table.sync());
  EXPECT_EQ(content(kRadioTable), radio_columns() +
                                      "\n10,1.0,uplink,bsm,9,5,1,2,3,11,12,13,14,4,52.25,95,99.5,0.25\n"
                                      "20,2.0,downlink,rsc,0,0,0,0,0,0,0,0,0,0,,,,\n");
  ASSERT_TRUE(table.entry());
  EXPECT_EQ(table.entry()->rows, 2);
}

}  // namespace
}  // namespace lukou::results
