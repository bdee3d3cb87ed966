// What the algorithms for the lights gain at unequal demand, west and east 2000, south and north 700 veh/h, minimum
// green 8 s, yellow 3 s, all-red 1 s: mean delay beside the fixed 90 s plan with an even split, and beside the best
// fixed plan, found by search over cycle and split on seeds of its own (101 and 102). 7400 s, the first 2000 s left
// out, the same arrivals seed by seed. Exit code 1 if a figure misses its goal, or a run has a collision or a reversal.
//   light_gains [--seeds N] [--no-search]
// Seeds 1 to N (10). --no-search takes the best plan that an earlier search found.

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/results/table_reader.hpp"
#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/product_run.hpp"

namespace {

using namespace lukou::test;
using nlohmann::json;

constexpr int kSearchSeed = 101;
constexpr int kSearchSeeds = 2;
constexpr int kClearance_s = 4;  // yellow and all-red after each green
constexpr int kMinGreen_s = 8;

/// Greens of west/east and south/north in whole seconds; the cycle has two clearances besides.
struct FixedPlan {
  int west_east_s = 41;
  int south_north_s = 41;

  [[nodiscard]] int cycle_s() const { return west_east_s + south_north_s + 2 * kClearance_s; }
};

/// What the search found: `light_gains --seeds 10`.
constexpr FixedPlan kFoundBest{.west_east_s = 21, .south_north_s = 8};

std::string scenario_of(const FixedPlan& plan) {
  char text[1500];
  std::snprintf(text, sizeof text,
                "traffic { west { flow_veh_per_h: 2000 } east { flow_veh_per_h: 2000 }\n"
                "          south { flow_veh_per_h: 700 } north { flow_veh_per_h: 700 } }\n"
                "signals { plan { cycle_s: %d\n"
                "  lane_plans { lanes: [\"WL\", \"WC\", \"WR\", \"EL\", \"EC\", \"ER\"]\n"
                "    aspects { aspect: GREEN duration_s: %d } aspects { aspect: YELLOW duration_s: 3 }\n"
                "    aspects { aspect: RED duration_s: %d } }\n"
                "  lane_plans { lanes: [\"SL\", \"SC\", \"SR\", \"NL\", \"NC\", \"NR\"]\n"
                "    aspects { aspect: RED duration_s: %d } aspects { aspect: GREEN duration_s: %d }\n"
                "    aspects { aspect: YELLOW duration_s: 3 } aspects { aspect: RED duration_s: 1 } } } }\n"
                "run { duration_s: 7400 warmup_s: 2000 on_overflow: CONTINUE }\nrsus { algorithm: \"none\" }\n",
                plan.cycle_s(), plan.west_east_s, plan.cycle_s() - plan.west_east_s - 3,
                plan.west_east_s + kClearance_s, plan.south_north_s);
  return text;
}

struct Outcome {
  double delay_s = 0.0;
  double west_east_s = 0.0;
  double south_north_s = 0.0;
  double stops = 0.0;
  double accidents = 0.0;
};

/// One run; delays of the axes are of the cars that have left.
Outcome outcome_of(const FixedPlan& plan, const std::vector<std::string>& settings, int seed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "light.textproto") << scenario_of(plan);
  std::vector<std::string> arguments = {"run",    (folder / "light.textproto").string(),
                                        "--json", "--quiet",
                                        "--mode", "in-process",
                                        "--seed", std::to_string(seed),
                                        "--out",  folder / "result"};
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  Program program(arguments);
  const int code = program.wait(3600.0);
  const json summary = report_of(program, code)["summary"];
  Outcome outcome{.delay_s = summary.at("mean_delay_s").get<double>(),
                  .stops = summary.at("stops_per_vehicle").get<double>(),
                  .accidents = summary.at("collisions").get<double>() + summary.at("reversals").get<double>()};
  std::array<double, 2> sum_s{};
  std::array<int, 2> cars{};
  const auto scan = lukou::results::scan_table(
      folder / "result" / "car.csv", [&](const std::vector<std::string_view>& cells, std::int64_t) -> std::string {
        if (std::stod(std::string(cells[3])) < 2000.0) return "";
        const std::size_t axis = cells[1][0] == 'W' || cells[1][0] == 'E' ? 0 : 1;
        sum_s[axis] += std::stod(std::string(cells[8]));
        ++cars[axis];
        return "";
      });
  if (!scan) std::fprintf(stderr, "%s\n", scan.error().text().c_str());
  outcome.west_east_s = sum_s[0] / cars[0];
  outcome.south_north_s = sum_s[1] / cars[1];
  return outcome;
}

double searched_delay_s(const FixedPlan& plan) {
  const auto runs = two_at_a_time<Outcome>(kSearchSeeds, [&](int i) { return outcome_of(plan, {}, kSearchSeed + i); });
  double sum_s = 0.0;
  for (const Outcome& run : runs) sum_s += run.delay_s;
  return sum_s / kSearchSeeds;
}

/// Downhill from the best of a coarse grid, a second at a time.
FixedPlan best_plan() {
  FixedPlan best;
  double least_s = searched_delay_s(best);
  const auto attempt = [&](const FixedPlan& plan) {
    if (plan.west_east_s < kMinGreen_s || plan.south_north_s < kMinGreen_s) return false;
    const double delay_s = searched_delay_s(plan);
    if (delay_s >= least_s) return false;
    best = plan;
    least_s = delay_s;
    return true;
  };
  for (const int south_north_s : {8, 12, 16, 24}) {
    for (const double ratio : {1.5, 2.0, 2.9}) {
      attempt({.west_east_s = static_cast<int>(ratio * south_north_s), .south_north_s = south_north_s});
    }
  }
  for (bool better = true; better;) {
    const FixedPlan from = best;
    better = false;
    for (const int change_s : {-2, -1, 1, 2}) {
      better = attempt({from.west_east_s + change_s, from.south_north_s}) || better;
      better = attempt({from.west_east_s, from.south_north_s + change_s}) || better;
    }
  }
  return best;
}

struct Control {
  std::string name;
  FixedPlan plan;
  std::vector<std::string> settings;
  double goal = 0.0;  ///< share of the delay that must be gone; 0: none
};

std::vector<std::string> on_request(const std::string& algorithm, const std::string& equipped_ratio, bool sensors) {
  std::vector<std::string> settings = {"signals.actuation.min_green_s=8", "rsus[0].algorithm=" + algorithm,
                                       "vehicles.equipped_ratio=" + equipped_ratio};
  const std::array<std::string, 4> approaches = {"WEST", "SOUTH", "EAST", "NORTH"};
  for (std::size_t i = 0; sensors && i < approaches.size(); ++i) {
    settings.push_back("rsus[0].sensors[" + std::to_string(i) + "].approach=" + approaches[i]);
  }
  return settings;
}

std::vector<Control> controls(const FixedPlan& best) {
  std::vector<Control> all = {{"fixed, 90 s, even split", {}, {}},
                              {"fixed, 90 s, split by demand", {.west_east_s = 60, .south_north_s = 22}, {}},
                              {"best fixed plan", best, {}},
                              {"`actuated`, sensors", {}, on_request("actuated", "0", true), 0.45},
                              {"`max_pressure`, sensors", {}, on_request("max_pressure", "0", true), 0.45},
                              {"`actuated`, heard cars, ratio 0.7", {}, on_request("actuated", "0.7", false)},
                              {"`max_pressure`, heard cars, ratio 0.7", {}, on_request("max_pressure", "0.7", false)}};
  for (const std::string ratio : {"1", "0.7", "0.3"}) {
    Control control{"`cv_phase`, heard cars, ratio " + ratio, {}, on_request("cv_phase", ratio, false)};
    control.settings.push_back("rsus[0].cv_phase.equipped_share=" + ratio);
    if (ratio == "0.7") control.goal = 0.40;
    all.push_back(control);
  }
  return all;
}

std::vector<double> column(const std::vector<Outcome>& runs, double Outcome::* member) {
  std::vector<double> values;
  for (const Outcome& run : runs) values.push_back(run.*member);
  return values;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = seeds_argument(argc, argv);
  const FixedPlan best = flag_argument(argc, argv, "no-search") ? kFoundBest : best_plan();
  std::printf("Best fixed plan: cycle %d s, %d s green for west and east, %d s for south and north.\n", best.cycle_s(),
              best.west_east_s, best.south_north_s);
  std::printf("Mean ± half width of the 95 %% interval over %d seeds; the change is paired.\n\n", seeds);
  std::printf(
      "| control | delay s | change %% | W and E s | S and N s | stops per vehicle |\n|---|---|---|---|---|---|\n");
  std::vector<double> even_s;
  bool well = true;
  double accidents = 0.0;
  for (const Control& control : controls(best)) {
    const auto runs =
        two_at_a_time<Outcome>(seeds, [&](int i) { return outcome_of(control.plan, control.settings, 1 + i); });
    const std::vector<double> delays_s = column(runs, &Outcome::delay_s);
    if (even_s.empty()) even_s = delays_s;
    std::vector<double> changes;
    for (std::size_t i = 0; i < delays_s.size(); ++i) changes.push_back(100.0 * (delays_s[i] / even_s[i] - 1.0));
    std::printf("| %s |", control.name.c_str());
    print_cell(delays_s, "%.2f ± %.2f");
    print_cell(changes, "%+.1f ± %.1f");
    print_cell(column(runs, &Outcome::west_east_s), "%.2f ± %.2f");
    print_cell(column(runs, &Outcome::south_north_s), "%.2f ± %.2f");
    print_cell(column(runs, &Outcome::stops), "%.3f ± %.3f");
    std::printf("\n");
    std::fflush(stdout);
    for (const double accident : column(runs, &Outcome::accidents)) accidents += accident;
    if (control.goal > 0.0 && estimate(changes).mean > -100.0 * control.goal) {
      well = false;
      std::printf("MISSED: %s is to be at least %.0f %% below the even split\n", control.name.c_str(),
                  100.0 * control.goal);
    }
  }
  std::printf("\ncollisions and reversals: %.0f\n", accidents);
  return well && accidents == 0.0 ? 0 : 1;
}
