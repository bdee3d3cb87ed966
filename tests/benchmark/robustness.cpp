// How the gain of guidance degrades with the downlink: latency, independent loss, loss in bursts, for two lifetimes of
// advice. 1800 veh/h on every approach, equipped ratio 0.7, 7400 s, the first 2000 s left out, seeds 1 to N (`--seeds
// N`, default 3). Prints the table of README.md. Exit code 1 if a run fails or has a collision.

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/product_run.hpp"

namespace {

using namespace lukou::test;
using nlohmann::json;

constexpr std::array<const char*, 4> kMeasures = {"mean_stop_time_s", "stops_per_vehicle", "mean_delay_s",
                                                  "mean_abs_acceleration_mps2"};
constexpr std::array<double, 2> kLifetimes_s = {0.5, 2.0};

/// A row of the table: what the downlink does to advice.
struct Case {
  std::string name;
  std::vector<std::string> settings;
};

Case latency_case(double latency_s) {
  char name[64];
  std::snprintf(name, sizeof name, "latency %.1f s", latency_s);
  return {name, {"radio.downlink.latency.constant_ms=" + std::to_string(latency_s * 1000.0)}};
}

Case loss_case(double rate) {
  char name[64];
  std::snprintf(name, sizeof name, "loss %.2f independent", rate);
  return {name, {"radio.downlink.loss.rate=" + std::to_string(rate)}};
}

Case burst_case(double rate, int mean_length) {
  char name[64];
  std::snprintf(name, sizeof name, "loss %.2f, bursts of %d", rate, mean_length);
  return {name,
          {"radio.downlink.loss.burst.rate=" + std::to_string(rate),
           "radio.downlink.loss.burst.mean_length=" + std::to_string(mean_length)}};
}

std::vector<Case> cases() {
  std::vector<Case> all = {{"ideal", {}}};
  for (const double latency_s : {0.2, 0.4, 0.5, 1.0, 1.9, 2.0, 3.0}) all.push_back(latency_case(latency_s));
  for (const double rate : {0.2, 0.5, 0.8, 0.95}) {
    all.push_back(loss_case(rate));
    for (const int mean_length : {5, 10, 20, 50}) {
      // Shorter bursts than independent losses have are no bursts.
      if (mean_length * (1.0 - rate) > 1.0 - 1e-9) all.push_back(burst_case(rate, mean_length));
    }
  }
  return all;
}

json summary_of(const std::vector<std::string>& settings, double equipped_ratio, int seed) {
  std::vector<std::string> arguments = paper_arguments("in-process", 1800.0, equipped_ratio, 7400.0, seed);
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return run_product(arguments)["summary"];
}

/// Runs a case for every seed and prints its row.
class Table {
 public:
  explicit Table(int seeds) : seeds_(seeds) {
    std::printf("%-26s", "downlink");
    for (const char* measure : kMeasures) std::printf(" %26s", measure);
    std::printf("   (mean +- half width of the 95 %% interval over %d seeds)\n", seeds);
  }

  void row(const std::string& name, const std::vector<std::string>& settings, double equipped_ratio = 0.7) {
    const auto runs = two_at_a_time<json>(seeds_, [&](int i) { return summary_of(settings, equipped_ratio, 1 + i); });
    std::printf("%-26s", name.c_str());
    for (const char* measure : kMeasures) {
      std::vector<double> values;
      for (const json& run : runs) values.push_back(run.at(measure).get<double>());
      const Estimate found = estimate(values);
      std::printf("          %7.3f +- %6.3f", found.mean, found.half_width);
    }
    std::printf("\n");
    std::fflush(stdout);
    for (const json& run : runs) collisions_ += run.at("collisions").get<int>();
  }
  [[nodiscard]] int collisions() const { return collisions_; }

 private:
  int seeds_;
  int collisions_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int seeds = seeds_argument(argc, argv, 3);
  Table table(seeds);
  table.row("no guidance", {}, 0.0);
  for (const double lifetime_s : kLifetimes_s) {
    std::printf("advice lifetime %.1f s\n", lifetime_s);
    for (Case each : cases()) {
      each.settings.push_back("rsus[0].arrive_on_green.lifetime_s=" + std::to_string(lifetime_s));
      table.row("  " + each.name, each.settings);
    }
  }
  std::printf("collisions: %d\n", table.collisions());
  return table.collisions() == 0 ? 0 : 1;
}
