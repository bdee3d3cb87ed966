// Runs the traffic engine without guidance and compares it with the reference figures of the study that decided the
// reading of the paper (docs/model.md). Exit code 1 if a figure leaves its band.

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/plain_run.hpp"

namespace {

using namespace lukou;
using test::BandTable;
using test::plain_parameters;
using test::PlainRun;
using test::within;

constexpr int kSeeds = 10;

/// Results of the seeds 1 ... kSeeds, two at a time.
template <class Result>
std::vector<Result> for_each_seed(const std::function<Result(int)>& run) {
  return test::two_at_a_time<Result>(kSeeds, [&run](int i) { return run(i + 1); });
}

double mean(const std::vector<RunFigures>& runs, const std::function<double(const RunFigures&)>& figure) {
  double sum = 0.0;
  for (const RunFigures& run : runs) sum += figure(run);
  return sum / static_cast<double>(runs.size());
}

struct Reference {
  double flow_veh_per_h;
  double delta_s;
  double delay_s;
  double stops;
  double stop_time_s;
};

constexpr std::array<Reference, 4> kReferences = {{{600.0, 15.5, 13.1, 0.39, 7.1},
                                                   {1200.0, 17.3, 15.1, 0.38, 7.0},
                                                   {1800.0, 19.6, 17.8, 0.38, 7.0},
                                                   {2400.0, 24.7, 23.3, 0.40, 7.9}}};
constexpr double kRun_s = 7400.0;
constexpr double kWarmup_s = 2000.0;

void add_safety(BandTable& table, const std::string& what, const std::vector<RunFigures>& runs) {
  table.row(what + " collisions", mean(runs, [](const RunFigures& f) { return double(f.collisions); }), {0.0, 0.0});
  table.row(what + " reversals", mean(runs, [](const RunFigures& f) { return double(f.reversals); }), {0.0, 0.0});
  double least_m = 1e9;
  for (const RunFigures& run : runs) least_m = std::min(least_m, run.min_head_distance_m.value_or(1e9));
  table.row(what + " least head distance m", least_m, {5.495, 6.0});
}

void compare_flow(BandTable& table, const Reference& reference) {
  const auto runs = for_each_seed<RunFigures>([&](int seed) {
    PlainRun run(plain_parameters(reference.flow_veh_per_h, seed), paper_plan(), kWarmup_s);
    run.run_to(kRun_s);
    return run.measures().figures();
  });
  const std::string flow = std::to_string(static_cast<int>(reference.flow_veh_per_h));
  table.row(flow + " throughput veh/h/approach",
            mean(runs, [](const RunFigures& f) { return *f.all.throughput_veh_per_h; }),
            within(reference.flow_veh_per_h, 0.015));
  table.row(flow + " mean delta s", mean(runs, [](const RunFigures& f) { return *f.all.mean_delta_s; }),
            within(reference.delta_s, 0.06));
  table.row(flow + " mean delay s", mean(runs, [](const RunFigures& f) { return *f.all.mean_delay_s; }),
            within(reference.delay_s, 0.06));
  table.row(flow + " stops per vehicle", mean(runs, [](const RunFigures& f) { return *f.all.stops_per_vehicle; }),
            {reference.stops - 0.03, reference.stops + 0.03});
  table.row(flow + " mean stop time s", mean(runs, [](const RunFigures& f) { return *f.all.mean_stop_time_s; }),
            within(reference.stop_time_s, 0.12));
  add_safety(table, flow, runs);
}

void compare_yellow(BandTable& table, double flow_veh_per_h) {
  const auto runs = for_each_seed<RunFigures>([&](int seed) {
    PlainRun run(plain_parameters(flow_veh_per_h, seed), paper_yellow_plan(), kWarmup_s);
    run.run_to(kRun_s);
    return run.measures().figures();
  });
  table.row(std::to_string(static_cast<int>(flow_veh_per_h)) + " with yellow: crossings on red",
            mean(runs, [](const RunFigures& f) { return double(f.red_crossings); }), {0.0, 0.0});
}

/// The n-th crossings of each green on a lane with a standing queue, and how many there are.
struct Discharge {
  double headway_sum_s = 0.0;
  double headways = 0.0;
  double capacity_veh_per_h = 0.0;
};

Discharge discharge(int seed) {
  auto demand = plain_parameters(3600.0, seed);
  demand.road.approach_m = 1000.0;
  PlainRun run(demand, paper_plan(), kWarmup_s);
  struct Last {
    Step cycle = -1;
    int place = 0;
    double at_s = 0.0;
  };
  std::array<Last, kLanes> last{};
  std::vector<int> lanes;  // by vehicle
  Discharge result;
  constexpr Step kCycle = 900;
  for (Step k = 1; k <= step_at_or_after(kWarmup_s + 30 * 90.0); ++k) {
    run.step();
    const TrafficBatch& batch = run.batch();
    for (std::size_t i = 0; i < batch.entered_vehicle.size(); ++i) {
      lanes.resize(std::max<std::size_t>(lanes.size(), batch.entered_vehicle[i] + 1U), -1);
      lanes[batch.entered_vehicle[i]] = batch.entered_lane[i];
    }
    for (std::size_t i = 0; i < batch.crossed_vehicle.size(); ++i) {
      if (batch.crossed_time_s[i] < kWarmup_s || batch.crossed_aspect[i] != static_cast<std::uint8_t>(Aspect::kGreen)) {
        continue;
      }
      Last& before = last[static_cast<std::size_t>(lanes[batch.crossed_vehicle[i]])];
      // Greens begin at 0 s or 45 s of the cycle and end within the next half: half-cycles tell them apart.
      const Step green = k / (kCycle / 2);
      const bool same = before.cycle == green;
      before.place = same ? before.place + 1 : 1;
      if (same && before.place >= 4) {
        result.headway_sum_s += batch.crossed_time_s[i] - before.at_s;
        result.headways += 1.0;
      }
      before.cycle = green;
      before.at_s = batch.crossed_time_s[i];
    }
  }
  result.capacity_veh_per_h = *run.measures().figures().all.throughput_veh_per_h;
  return result;
}

void compare_saturation(BandTable& table) {
  double headway_s = 0.0;
  double headways = 0.0;
  double capacity_veh_per_h = 0.0;
  for (const Discharge& one : for_each_seed<Discharge>(discharge)) {
    headway_s += one.headway_sum_s;
    headways += one.headways;
    capacity_veh_per_h += one.capacity_veh_per_h / kSeeds;
  }
  table.row("saturation headway s (4th car on)", headway_s / headways, {1.95, 2.06});
  table.row("capacity veh/h/approach", capacity_veh_per_h, within(2702.0, 0.02));
}

/// Time from which on the running mean stop time stays within 5 % of its final value.
double settling_time_s(int seed) {
  constexpr double kEnd_s = 10800.0;
  PlainRun run(plain_parameters(1800.0, seed), paper_plan(), 0.0);
  std::vector<double> running;
  for (Step k = 1; k <= step_at_or_after(kEnd_s); ++k) {
    run.step();
    double stop_time_s = 0.0;
    for (const LaneTotals& lane : run.measures().lanes()) stop_time_s += lane.stop_time_s();
    const auto entered = static_cast<double>(run.measures().entered());
    running.push_back(entered > 0.0 ? stop_time_s / entered : 0.0);
  }
  std::size_t from = running.size();
  while (from > 0 && std::abs(running[from - 1] / running.back() - 1.0) <= 0.05) --from;
  return time_s(static_cast<Step>(from) + 1);
}

void compare_settling(BandTable& table) {
  double sum_s = 0.0;
  for (const double at_s : for_each_seed<double>(settling_time_s)) sum_s += at_s;
  table.row("figure 6: settled within 5 % after s", sum_s / kSeeds, {900.0, 1700.0});
}

}  // namespace

int main() {
  BandTable table;
  for (const Reference& reference : kReferences) compare_flow(table, reference);
  for (const double flow_veh_per_h : {600.0, 1200.0, 1800.0}) compare_yellow(table, flow_veh_per_h);
  compare_saturation(table);
  compare_settling(table);
  std::printf(table.all_inside() ? "all figures inside their bands\n" : "some figure is OUTSIDE its band\n");
  return table.all_inside() ? 0 : 1;
}
