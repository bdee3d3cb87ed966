#include "tests/determinism/golden.hpp"

#include "common/results/inspection.hpp"

namespace lukou::test {

// These hashes are the project's word that the same scenario gives the same bytes on every machine. They change only in
// a commit whose message says why the results change; a failing test is no reason to paste new ones.
const std::vector<GoldenRun>& golden_runs() {
  static const std::vector<GoldenRun> kRuns = {
      {.name = "the paper's scenario",
       .arguments = {"run", "paper", "--mode", "in-process", "--duration", "600", "--seed", "1", "--quiet"},
       .golden = R"(@A@)"},
      {.name = "protected left turns under changing demand",
       .arguments =
           {"run",
            "paper",
            "--mode",
            "in-process",
            "--duration",
            "600",
            "--seed",
            "20260",
            "--quiet",
            "--set",
            "signals.preset=PROTECTED_LEFT",
            "--set",
            "vehicles.equipped_ratio=0.3",
            "--set",
            "traffic.west={flow_series {from_s: 0 flow_veh_per_h: 400} flow_series {from_s: 200 "
            "flow_veh_per_h: 1300} flow_series {from_s: 450 flow_veh_per_h: 0}}",
            "--set",
            "traffic.south.flow_veh_per_h=900",
            "--set",
            "traffic.east.flow_veh_per_h=600",
            "--set",
            "traffic.north={flow_series {from_s: 60 flow_veh_per_h: 1000} shares {left: 3 center: 2 right: 1}}"},
       .golden = R"(@B@)"}};
  return kRuns;
}

std::string fingerprint(const GoldenRun& run, const std::vector<std::string>& environment, const std::string& program) {
  const TemporaryFolder folder;
  auto arguments = run.arguments;
  arguments.insert(arguments.end(), {"--out", folder / "result"});
  Program started(arguments, environment, program);
  const int code = started.wait();
  if (code != 0) return program + " ended with code " + std::to_string(code) + "\n" + started.out() + started.err();
  const auto files = results::result_files(folder / "result");
  if (!files) return files.error().text();
  std::string text;
  for (const auto& file : files.value()) text += file.name + " " + file.sha256 + "\n";
  return text;
}

}  // namespace lukou::test
