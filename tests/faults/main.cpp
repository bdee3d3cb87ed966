// Kills, stops, slows and restarts the processes of real runs at random, and looks at what becomes of them. Every run
// is drawn from one number, which the table prints: `fault_runs --runs 1 --seed N` draws it again. (Not the moment:
// that depends on the machine.)
//   fault_runs [--runs N] [--seed N] [--keep FOLDER]      exit code 1 if anything was wrong

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>

#include "tests/faults/judge.hpp"
#include "tests/system/program.hpp"

using namespace lukou;
using namespace lukou::faults;

namespace {

namespace fs = std::filesystem;

struct Arguments {
  int runs = 12;
  std::uint64_t seed = 1;
  std::string keep;
};

std::string seen(const Done& done) {
  if (!done.hit) return " (not there)";
  if (done.seen < 0) return " (forming)";
  return " (seen " + std::to_string(done.seen) + (done.over ? ", ending)" : ")");
}

void print(const Plan& plan, const Observed& observed, const Verdict& verdict) {
  std::string faults;
  for (std::size_t i = 0; i < plan.faults.size(); ++i)
    faults += (i > 0 ? "; " : "") + plan.faults[i].text() + seen(observed.done[i]);
  std::printf("%5llu  %-8s %u %-8s %4s  %4d %-24s %6lld/%-6lld %5.1f  %s%s\n",
              static_cast<unsigned long long>(plan.seed), plan.scenario.c_str(), plan.rsus, plan.policy.c_str(),
              plan.pace.c_str(), observed.code, verdict.ended.c_str(), static_cast<long long>(verdict.complete_to),
              static_cast<long long>(verdict.planned), observed.wall_s, faults.c_str(),
              plan.console ? "; with console" : "");
  for (const Complaint& complaint : verdict.complaints)
    std::printf("       WRONG (%s): %s\n", name(complaint.wrong).c_str(), complaint.text.c_str());
  std::fflush(stdout);
}

int run(const Arguments& arguments) {
  std::array<int, kWrongs> wrongs{};
  int bad_runs = 0;
  std::uint32_t returned = 0;
  std::printf(" seed  scenario RSUs, loss pace  code ended by                   step/planned wall s  what was done\n");
  for (int i = 0; i < arguments.runs; ++i) {
    const Plan plan = draw(arguments.seed + static_cast<std::uint64_t>(i));
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "scratch");
    const Observed observed = make_run(plan, folder / "r");
    const Verdict verdict = judge(plan, observed, folder / "r", folder / "scratch");
    print(plan, observed, verdict);
    returned += verdict.returned;
    for (const Complaint& complaint : verdict.complaints) ++wrongs[static_cast<std::size_t>(complaint.wrong)];
    if (verdict.complaints.empty()) continue;
    ++bad_runs;
    if (arguments.keep.empty()) continue;
    std::error_code none;
    fs::create_directories(arguments.keep, none);
    fs::copy(folder / "r", fs::path(arguments.keep) / std::to_string(plan.seed), fs::copy_options::recursive, none);
  }
  std::printf("%d runs, %d not as they should be; %u returns of lost RSUs\n", arguments.runs, bad_runs, returned);
  for (int wrong = 0; wrong < kWrongs; ++wrong)
    std::printf("%6d %s\n", wrongs[static_cast<std::size_t>(wrong)], name(static_cast<Wrong>(wrong)).c_str());
  return bad_runs == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Faults done to real runs at random, and what becomes of them.");
  Arguments arguments;
  app.add_option("--runs", arguments.runs, "how many")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--seed", arguments.seed, "of the first run; the next ones follow")->capture_default_str();
  app.add_option("--keep", arguments.keep, "folder for the results of runs that are not as they should be");
  CLI11_PARSE(app, argc, argv);
  return run(arguments);
}
