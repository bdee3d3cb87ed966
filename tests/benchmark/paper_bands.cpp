// Runs the traffic engine without guidance and compares it with the reference figures of the study that decided the
// reading of the paper (docs/model.md). Exit code 1 if a figure leaves its band.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/intersection/signal_plan.hpp"
#include "common/measures/run_measures.hpp"
#include "services/traffic_engine/model/engine.hpp"
#include "services/traffic_engine/traffic_report.hpp"

namespace {

using namespace lukou;

constexpr int kSeeds = 10;

/// One run without guidance, step by step.
class PlainRun {
 public:
  PlainRun(const traffic::EngineParameters& parameters, SignalPlan plan, double warmup_s)
      : engine_(parameters), plan_(std::move(plan)), measures_(measure_parameters(parameters, warmup_s)) {
    step();
  }

  void step() {
    Heads heads{};
    for (int i = 0; i < kLanes; ++i) heads[index(Lane(i))] = aspect_at(plan_, Lane(i), next_ - 1);
    engine_.step(next_, heads, {});
    report(engine_, next_, batch_);
    measures_.add(batch_);
    ++next_;
  }
  void run_to(double end_s) {
    while (next_ <= step_at_or_after(end_s)) step();
  }
  [[nodiscard]] const TrafficBatch& batch() const { return batch_; }
  [[nodiscard]] const RunMeasures& measures() const { return measures_; }

 private:
  static MeasureParameters measure_parameters(const traffic::EngineParameters& parameters, double warmup_s) {
    MeasureParameters measure;
    measure.warmup_s = warmup_s;
    measure.road = parameters.road;
    return measure;
  }

  traffic::Engine engine_;
  SignalPlan plan_;
  RunMeasures measures_;
  TrafficBatch batch_;
  Step next_ = 0;
};

traffic::EngineParameters parameters(double flow_veh_per_h, int seed) {
  traffic::EngineParameters engine;
  engine.seed = static_cast<std::uint64_t>(seed);
  engine.equipped_ratio = 0.0;
  for (auto& demand : engine.demand) demand.flows = {{.from_s = 0.0, .flow_veh_per_h = flow_veh_per_h}};
  return engine;
}

/// Results of the seeds 1 ... kSeeds, two at a time.
template <class Result>
std::vector<Result> for_each_seed(const std::function<Result(int)>& run) {
  std::vector<Result> results;
  for (int seed = 1; seed <= kSeeds; seed += 2) {
    auto second = std::async(std::launch::async, run, seed + 1);
    results.push_back(run(seed));
    results.push_back(second.get());
  }
  return results;
}

struct Band {
  double low;
  double high;
};

class Table {
 public:
  void row(const std::string& what, double value, Band band) {
    const bool inside = value >= band.low && value <= band.high;
    all_inside_ = all_inside_ && inside;
    std::printf("%-46s %10.3f   [%.3f, %.3f]  %s\n", what.c_str(), value, band.low, band.high,
                inside ? "ok" : "OUTSIDE");
  }
  [[nodiscard]] bool all_inside() const { return all_inside_; }

 private:
  bool all_inside_ = true;
};

Band within(double value, double share) { return {value * (1.0 - share), value * (1.0 + share)}; }

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

void add_safety(Table& table, const std::string& what, const std::vector<RunFigures>& runs) {
  table.row(what + " collisions", mean(runs, [](const RunFigures& f) { return double(f.collisions); }), {0.0, 0.0});
  table.row(what + " reversals", mean(runs, [](const RunFigures& f) { return double(f.reversals); }), {0.0, 0.0});
  double least_m = 1e9;
  for (const RunFigures& run : runs) least_m = std::min(least_m, run.min_head_distance_m.value_or(1e9));
  table.row(what + " least head distance m", least_m, {5.495, 6.0});
}

void compare_flow(Table& table, const Reference& reference) {
  const auto runs = for_each_seed<RunFigures>([&](int seed) {
    PlainRun run(parameters(reference.flow_veh_per_h, seed), paper_plan(), kWarmup_s);
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

void compare_yellow(Table& table, double flow_veh_per_h) {
  const auto runs = for_each_seed<RunFigures>([&](int seed) {
    PlainRun run(parameters(flow_veh_per_h, seed), paper_yellow_plan(), kWarmup_s);
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
  auto demand = parameters(3600.0, seed);
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

void compare_saturation(Table& table) {
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
  PlainRun run(parameters(1800.0, seed), paper_plan(), 0.0);
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

void compare_settling(Table& table) {
  double sum_s = 0.0;
  for (const double at_s : for_each_seed<double>(settling_time_s)) sum_s += at_s;
  table.row("figure 6: settled within 5 % after s", sum_s / kSeeds, {900.0, 1700.0});
}

/// Vehicle updates per second of the engine alone, one thread, 1800 veh/h, with noise.
double updates_per_s() {
  traffic::Engine engine(parameters(1800.0, 1));
  const SignalPlan plan = paper_plan();
  std::array<Heads, 900> cycle{};
  for (Step k = 0; k < 900; ++k)
    for (int i = 0; i < kLanes; ++i) cycle[static_cast<std::size_t>(k)][index(Lane(i))] = aspect_at(plan, Lane(i), k);
  double updates = 0.0;
  const auto start = std::chrono::steady_clock::now();
  for (Step k = 0; k <= 108000; ++k) {
    engine.step(k, cycle[static_cast<std::size_t>((k + 899) % 900)], {});
    for (int i = 0; i < kLanes; ++i) updates += static_cast<double>(engine.lane(Lane(i)).cars().size());
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return updates / took.count();
}

}  // namespace

int main() {
  Table table;
  for (const Reference& reference : kReferences) compare_flow(table, reference);
  for (const double flow_veh_per_h : {600.0, 1200.0, 1800.0}) compare_yellow(table, flow_veh_per_h);
  compare_saturation(table);
  compare_settling(table);
  std::printf("vehicle updates per second, engine alone: %.1f million\n", updates_per_s() / 1e6);
  std::printf(table.all_inside() ? "all figures inside their bands\n" : "some figure is OUTSIDE its band\n");
  return table.all_inside() ? 0 : 1;
}
