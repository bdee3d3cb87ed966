// Runs per minute of a study with two jobs beside one, in pairs whose order alternates. Prints each pair and the median
// of their ratios. Every run of every sweep has to be that of `lukou run` alone, by its manifest with the hashes of all
// files: exit code 1 if one is not, or fails. Speed decides nothing.
//   sweep_jobs [--pairs N] [--runs N] [--duration S]

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/system/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace lukou::test;

class Sweeps {
 public:
  Sweeps(int runs, double duration_s) : runs_(runs) {
    std::ofstream(study_) << "scenario: \"paper\"\nset: \"run.duration_s=" << duration_s
                          << "\"\nset: \"run.warmup_s=100\"\nseeds { count: " << runs << " }\n";
  }

  /// Makes the study's runs with so many jobs. Returns runs per minute of wall time.
  double runs_per_minute(int jobs) {
    const fs::path out = folder_ / "study";
    const auto begin = std::chrono::steady_clock::now();
    const Finished ended =
        lukou::test::lukou({"sweep", study_.string(), "--jobs", std::to_string(jobs), "--quiet", "--out", out});
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (ended.code != 0) {
      std::fprintf(stderr, "%s", ended.err.c_str());
      ++wrong_;
    }
    check(out);
    fs::remove_all(out);
    return 60.0 * runs_ / wall_s;
  }

  [[nodiscard]] int wrong() const { return wrong_; }

 private:
  void check(const fs::path& out) {
    for (int seed = 1; seed <= runs_; ++seed) {
      const fs::path result = out / "runs" / ("p000-s" + std::to_string(seed)) / "result";
      const std::string manifest = content(result / "manifest.json");
      if (static_cast<int>(alone_.size()) < seed) alone_.push_back(manifest_of_run_alone(result, seed));
      const bool same = !manifest.empty() && manifest == alone_[static_cast<std::size_t>(seed - 1)];
      wrong_ += same ? 0 : 1;
    }
  }

  std::string manifest_of_run_alone(const fs::path& result, int seed) {
    const fs::path out = folder_ / ("alone-" + std::to_string(seed));
    const Finished ended = lukou::test::lukou(
        {"run", (result / "scenario.textproto").string(), "--mode", "in-process", "--quiet", "--out", out});
    if (ended.code != 0) std::fprintf(stderr, "%s", ended.err.c_str());
    return content(out / "manifest.json");
  }

  TemporaryFolder folder_;
  fs::path study_ = folder_ / "speed.textproto";
  int runs_;
  std::vector<std::string> alone_;  ///< manifests, by seed
  int wrong_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int pairs = static_cast<int>(number_argument(argc, argv, "pairs", 5));
  const int runs = static_cast<int>(number_argument(argc, argv, "runs", 8));
  const double duration_s = number_argument(argc, argv, "duration", 3600.0);
  Sweeps sweeps(runs, duration_s);
  std::printf(
      "%d runs of %.0f s a sweep\n| pair | one job, runs/min | two jobs, runs/min | times |\n|---|---|---|---|\n", runs,
      duration_s);
  std::vector<double> ratios;
  for (int pair = 0; pair < pairs; ++pair) {
    const bool two_first = pair % 2 == 1;
    double two = two_first ? sweeps.runs_per_minute(2) : 0.0;
    const double one = sweeps.runs_per_minute(1);
    if (!two_first) two = sweeps.runs_per_minute(2);
    ratios.push_back(two / one);
    std::printf("| %d | %.1f | %.1f | %.2f |\n", pair + 1, one, two, ratios.back());
    std::fflush(stdout);
  }
  const Spread found = spread(ratios);
  std::printf("median %.2f [%.2f, %.2f], aimed at 1.8; %d of %d results are not those of the run alone\n", found.median,
              found.least, found.most, sweeps.wrong(), 2 * pairs * runs);
  return sweeps.wrong() == 0 ? 0 : 1;
}
