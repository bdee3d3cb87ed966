// Ten hours at 600, 1800 and 2400 veh/h on every approach with `arrive_on_green`, in-process through the whole program,
// two runs at a time: no collision, no reversal, the least distance of two heads, and memory that does not grow.
//   long_runs [--seeds N] [--ratio R] [--flow F]      seeds 1 to N (10), equipped ratio (0.7), only this flow
// Prints a table; exit code 1 if a rule is broken.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/product_run.hpp"

namespace {

using namespace lukou::test;
namespace fs = std::filesystem;

constexpr double kRun_s = 36000.0;
constexpr double kSettled_s = 2000.0;
constexpr long kStepsPerSecond = 10;
/// Standing heads are 5.5 m apart; the rest is the rounding of the model's step (docs/model.md).
constexpr double kHeadDistanceMin_m = 5.49;
constexpr double kGrowthMax_kb = 1000.0;

/// Rows of a table that a run is writing, its header not counted.
class RowCount {
 public:
  explicit RowCount(const fs::path& table) : table_(table) {}
  long rows() {
    if (!stream_.is_open()) stream_.open(table_, std::ios::binary);
    stream_.clear();
    std::string piece(1 << 16, '\0');
    while (stream_.is_open()) {
      stream_.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      if (stream_.gcount() == 0) break;
      lines_ += std::count(piece.begin(), piece.begin() + stream_.gcount(), '\n');
    }
    return std::max(0L, lines_ - 1);
  }

 private:
  fs::path table_;
  std::ifstream stream_;
  long lines_ = 0;
};

struct LongRun {
  double flow_veh_per_h = 0.0;
  int seed = 0;
  double collisions = 0.0;
  double reversals = 0.0;
  double min_head_distance_m = 0.0;
  double settled_kb = 0.0;   ///< resident when 2000 s were simulated
  double last_kb = 0.0;      ///< resident at the last look before the end
  double last_look_s = 0.0;  ///< simulated time of that look
  double steps_per_s = 0.0;
};

LongRun long_run(double flow_veh_per_h, double equipped_ratio, int seed) {
  LongRun result{.flow_veh_per_h = flow_veh_per_h, .seed = seed};
  const TemporaryFolder folder;
  auto arguments = paper_arguments("in-process", flow_veh_per_h, equipped_ratio, kRun_s, seed);
  arguments.insert(arguments.end(), {"--out", folder / "result"});
  Program program(arguments);
  RowCount count(folder / "result" / "road.csv");
  while (program.running()) {
    const double kb = memory_kb(program.pid(), "VmRSS");
    // Rows reach the file in blocks, so the run is at least as far as they say. After the last row the run is at its
    // end and hashes its files, which is no longer simulation.
    const long rows = count.rows();
    const double simulated_s = static_cast<double>(rows) / kStepsPerSecond;
    if (kb > 0.0 && simulated_s >= kSettled_s && simulated_s < kRun_s) {
      if (result.settled_kb == 0.0) result.settled_kb = kb;
      result.last_kb = kb;
      result.last_look_s = simulated_s;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const nlohmann::json report = report_of(program, program.wait());
  result.collisions = report["summary"]["collisions"].get<double>();
  result.reversals = report["summary"]["reversals"].get<double>();
  result.min_head_distance_m = report["summary"]["min_head_distance_m"].get<double>();
  result.steps_per_s = report["timing"]["steps_per_s"].get<double>();
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = static_cast<int>(number_argument(argc, argv, "seeds", 10.0));
  const double ratio = number_argument(argc, argv, "ratio", 0.7);
  const double only_veh_per_h = number_argument(argc, argv, "flow", 0.0);
  std::vector<double> flows_veh_per_h = {600.0, 1800.0, 2400.0};
  if (only_veh_per_h > 0.0) flows_veh_per_h = {only_veh_per_h};
  if (seeds < 1) {
    std::fprintf(stderr, "--seeds: needs at least 1\n");
    return 2;
  }
  BandTable table;
  std::printf("%8s %5s %10s %9s %12s %12s %12s %10s %9s\n", "veh/h", "seed", "collisions", "reversals", "heads [m]",
              "2000 s [kB]", "end [kB]", "growth", "steps/s");
  for (const double flow_veh_per_h : flows_veh_per_h) {
    const auto runs = two_at_a_time<LongRun>(seeds, [&](int i) { return long_run(flow_veh_per_h, ratio, i + 1); });
    double accidents = 0.0;
    double least_m = 1e9;
    double growth_kb = 0.0;
    double earliest_last_look_s = kRun_s;
    for (const LongRun& run : runs) {
      std::printf("%8.0f %5d %10.0f %9.0f %12.4f %12.0f %12.0f %10.0f %9.0f\n", run.flow_veh_per_h, run.seed,
                  run.collisions, run.reversals, run.min_head_distance_m, run.settled_kb, run.last_kb,
                  run.last_kb - run.settled_kb, run.steps_per_s);
      accidents += run.collisions + run.reversals;
      least_m = std::min(least_m, run.min_head_distance_m);
      growth_kb = std::max(growth_kb, run.last_kb - run.settled_kb);
      earliest_last_look_s = std::min(earliest_last_look_s, run.last_look_s);
    }
    const std::string flow = std::to_string(static_cast<int>(flow_veh_per_h)) + " veh/h: ";
    table.row(flow + "collisions and reversals", accidents, {0.0, 0.0});
    table.row(flow + "least head distance m", least_m, {kHeadDistanceMin_m, 1e3});
    table.row(flow + "largest growth of memory kB", growth_kb, {-1e6, kGrowthMax_kb});
    table.row(flow + "memory looked at until s", earliest_last_look_s, {0.95 * kRun_s, kRun_s});
  }
  std::printf(table.all_inside() ? "all runs keep the rules\n" : "some run BREAKS a rule\n");
  return table.all_inside() ? 0 : 1;
}
