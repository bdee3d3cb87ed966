// What each RSU algorithm that ships gains and costs against `none`, through the whole program: equal seeds have equal
// arrivals, so the differences are taken seed by seed. 7400 s, the first 2000 s left out. Prints the tables of
// docs/algorithms.md. Exit code 1 if a run fails or has a collision or a reversal.
//   algorithm_gains [--seeds N] [--flow F] [--ratio R] [--sets "path=value path=value"]
// Seeds 1 to N (10); flows 600, 1200, 1800, 2400 veh/h on every approach and equipped ratios 0.3, 0.7 and 1, or only
// the one that is named. Settings apply to every run.

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/product_run.hpp"

namespace {

using namespace lukou::test;
using nlohmann::json;

constexpr std::array<const char*, 6> kAlgorithms = {"glosa",   "glosa_queue",         "eco",
                                                    "platoon", "speed_harmonisation", "arrive_on_green"};
constexpr std::array<const char*, 4> kMeasures = {"mean_stop_time_s", "mean_delay_s", "stops_per_vehicle",
                                                  "mean_abs_acceleration_mps2"};

/// The runs of one flow and all seeds, and what they add up to.
class Comparison {
 public:
  Comparison(int seeds, double flow_veh_per_h, std::vector<std::string> settings)
      : seeds_(seeds), flow_veh_per_h_(flow_veh_per_h), settings_(std::move(settings)) {
    without_ = runs_of("none", 0.0);
  }

  void print(double equipped_ratio) {
    std::printf("\n%.0f veh/h, equipped ratio %.1f\n\n", flow_veh_per_h_, equipped_ratio);
    std::printf("| algorithm | stop time s | delay s | stops per vehicle | mean abs. acceleration m/s2 |\n");
    std::printf("|---|---|---|---|---|\n| `none` |");
    for (const char* measure : kMeasures) print_cell(values(without_, measure), "%.3f ± %.3f");
    std::printf("\n");
    for (const char* algorithm : kAlgorithms) {
      const std::vector<json> with = runs_of(algorithm, equipped_ratio);
      std::printf("| `%s` |", algorithm);
      for (const char* measure : kMeasures) {
        std::vector<double> changes = values(with, measure);
        const std::vector<double> before = values(without_, measure);
        for (std::size_t i = 0; i < changes.size(); ++i) changes[i] -= before[i];
        print_cell(changes, "%+.3f ± %.3f");
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  [[nodiscard]] double accidents() const { return accidents_; }
  [[nodiscard]] int other_arrivals() const { return other_arrivals_; }

 private:
  std::vector<json> runs_of(const std::string& algorithm, double equipped_ratio) {
    auto runs = two_at_a_time<json>(seeds_, [&](int i) {
      auto arguments = paper_arguments("in-process", flow_veh_per_h_, equipped_ratio, 7400.0, 1 + i);
      arguments.insert(arguments.end(), {"--rsu-algorithm", algorithm});
      for (const std::string& setting : settings_) arguments.insert(arguments.end(), {"--set", setting});
      return run_product(arguments)["summary"];
    });
    for (std::size_t i = 0; i < runs.size(); ++i) {
      accidents_ += runs[i].at("collisions").get<double>() + runs[i].at("reversals").get<double>();
      if (!without_.empty() && runs[i].at("vehicles_arrived") != without_[i].at("vehicles_arrived")) ++other_arrivals_;
    }
    return runs;
  }
  static std::vector<double> values(const std::vector<json>& runs, const char* measure) {
    std::vector<double> found;
    for (const json& run : runs) found.push_back(run.at(measure).get<double>());
    return found;
  }

  int seeds_;
  double flow_veh_per_h_;
  std::vector<std::string> settings_;
  std::vector<json> without_;
  double accidents_ = 0.0;
  int other_arrivals_ = 0;
};

std::vector<double> chosen(int argc, char** argv, const char* name, std::vector<double> all) {
  const double only = number_argument(argc, argv, name, 0.0);
  if (only > 0.0) return {only};
  return all;
}

std::vector<std::string> settings_argument(int argc, char** argv) {
  std::vector<std::string> settings;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string("--sets") != argv[i]) continue;
    std::istringstream words(argv[i + 1]);
    for (std::string word; words >> word;) settings.push_back(word);
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = seeds_argument(argc, argv);
  std::printf("`none`: mean ± half width of the 95 %% interval over %d seeds; the others: what they change, paired.\n",
              seeds);
  double accidents = 0.0;
  int other_arrivals = 0;
  for (const double flow_veh_per_h : chosen(argc, argv, "flow", {600.0, 1200.0, 1800.0, 2400.0})) {
    Comparison comparison(seeds, flow_veh_per_h, settings_argument(argc, argv));
    for (const double ratio : chosen(argc, argv, "ratio", {0.3, 0.7, 1.0})) comparison.print(ratio);
    accidents += comparison.accidents();
    other_arrivals += comparison.other_arrivals();
  }
  std::printf("\ncollisions and reversals: %.0f; runs with other arrivals: %d\n", accidents, other_arrivals);
  return accidents == 0.0 && other_arrivals == 0 ? 0 : 1;
}
