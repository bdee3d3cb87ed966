// What `arrive_on_green` gains at 1800 veh/h on every approach, through the whole program: the same arrivals at
// equipped ratio 0, 0.7 and 1. Seeds 1 to N (`--seeds N`, default 10), 7400 s each, the first 2000 s left out. Exit
// code 1 if a figure leaves its band.

#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/product_run.hpp"

namespace {

using namespace lukou::test;
using nlohmann::json;

constexpr std::array<double, 3> kRatios = {0.0, 0.7, 1.0};
constexpr std::array<const char*, 5> kMeasures = {"mean_stop_time_s", "mean_delay_s", "mean_delta_s",
                                                  "stops_per_vehicle", "throughput_veh_per_h"};

/// One summary for each ratio and seed.
class Summaries {
 public:
  explicit Summaries(int seeds) : seeds_(seeds) {
    runs_ = two_at_a_time<json>(seeds * static_cast<int>(kRatios.size()), [](int i) {
      const double ratio = kRatios[static_cast<std::size_t>(i) % kRatios.size()];
      const int seed = 1 + i / static_cast<int>(kRatios.size());
      return run_product(paper_arguments("in-process", 1800.0, ratio, 7400.0, seed))["summary"];
    });
  }

  [[nodiscard]] const json& at(std::size_t ratio, int seed_index) const {
    return runs_[static_cast<std::size_t>(seed_index) * kRatios.size() + ratio];
  }
  /// A figure by seed.
  [[nodiscard]] std::vector<double> values(const char* measure, std::size_t ratio) const {
    std::vector<double> found;
    for (int i = 0; i < seeds_; ++i) found.push_back(at(ratio, i).at(measure).get<double>());
    return found;
  }
  /// What guidance changes, seed by seed.
  [[nodiscard]] std::vector<double> changes(const char* measure, std::size_t ratio) const {
    std::vector<double> found = values(measure, ratio);
    const std::vector<double> without = values(measure, 0);
    for (std::size_t i = 0; i < found.size(); ++i) found[i] -= without[i];
    return found;
  }
  /// Seeds whose number of arrived vehicles depends on the ratio.
  [[nodiscard]] int seeds_with_other_arrivals() const {
    int count = 0;
    for (int i = 0; i < seeds_; ++i) {
      const json& arrived = at(0, i).at("vehicles_arrived");
      if (at(1, i).at("vehicles_arrived") != arrived || at(2, i).at("vehicles_arrived") != arrived) ++count;
    }
    return count;
  }
  /// Sum over all runs.
  [[nodiscard]] double total(const char* figure) const {
    double sum = 0.0;
    for (const json& run : runs_) sum += run.at(figure).get<double>();
    return sum;
  }

 private:
  int seeds_;
  std::vector<json> runs_;
};

void print(const Summaries& summaries) {
  std::printf("mean +- half width of the 95 %% interval\n");
  std::printf("%-22s", "equipped ratio");
  for (const double ratio : kRatios) std::printf(" %20.1f", ratio);
  std::printf(" %20s %20s\n", "0.7 against 0", "1.0 against 0");
  for (const char* measure : kMeasures) {
    std::printf("%-22s", measure);
    for (std::size_t ratio = 0; ratio < kRatios.size(); ++ratio) {
      const Estimate found = estimate(summaries.values(measure, ratio));
      std::printf(" %11.3f +- %5.3f", found.mean, found.half_width);
    }
    for (const std::size_t ratio : {1U, 2U}) {
      const Estimate found = estimate(summaries.changes(measure, ratio));
      std::printf(" %+11.3f +- %5.3f", found.mean, found.half_width);
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = seeds_argument(argc, argv);
  const Summaries summaries(seeds);
  print(summaries);

  const double stop_time_s = estimate(summaries.values("mean_stop_time_s", 0)).mean;
  const double stop_time_change = 100.0 * estimate(summaries.changes("mean_stop_time_s", 1)).mean / stop_time_s;
  constexpr double kNoLimit = -std::numeric_limits<double>::infinity();
  BandTable table;
  table.row("mean stop time at 0.7, change in %", stop_time_change, {-100.0, -70.0});
  table.row("mean delay at 0.7, change in s", estimate(summaries.changes("mean_delay_s", 1)).mean, {kNoLimit, 0.0});
  table.row("mean delay at 1.0, change in s", estimate(summaries.changes("mean_delay_s", 2)).mean, {kNoLimit, -1e-9});
  table.row("seeds whose arrivals differ", summaries.seeds_with_other_arrivals(), {0.0, 0.0});
  table.row("collisions", summaries.total("collisions"), {0.0, 0.0});
  table.row("reversals", summaries.total("reversals"), {0.0, 0.0});
  std::printf(table.all_inside() ? "all figures inside their bands\n" : "some figure is OUTSIDE its band\n");
  return table.all_inside() ? 0 : 1;
}
