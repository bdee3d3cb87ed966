#include "tests/benchmark/product_run.hpp"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace lukou::test {

std::vector<std::string> paper_arguments(const std::string& mode, double flow_veh_per_h, double equipped_ratio,
                                         double duration_s, int seed) {
  std::vector<std::string> arguments = {"run", "paper", "--json", "--quiet", "--mode", mode};
  arguments.insert(arguments.end(), {"--seed", std::to_string(seed), "--duration", std::to_string(duration_s)});
  arguments.insert(arguments.end(), {"--set", "run.warmup_s=2000"});
  arguments.insert(arguments.end(), {"--set", "vehicles.equipped_ratio=" + std::to_string(equipped_ratio)});
  for (const std::string approach : {"west", "south", "east", "north"}) {
    const std::string path = "traffic." + approach + ".flow_veh_per_h=";
    arguments.insert(arguments.end(), {"--set", path + std::to_string(flow_veh_per_h)});
  }
  return arguments;
}

nlohmann::json report_of(Program& ended, int exit_code) {
  nlohmann::json report = nlohmann::json::parse(ended.out(), nullptr, false);
  if (exit_code == 0 && report.is_object()) return report;
  std::fprintf(stderr, "a run ended with code %d\n%s%s", exit_code, ended.out().c_str(), ended.err().c_str());
  std::fflush(nullptr);
  std::_Exit(1);  // other runs may still be under way in other threads
}

nlohmann::json run_product(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.end(), {"--out", folder / "result"});
  Program program(arguments);
  const int code = program.wait(3600.0);
  return report_of(program, code);
}

double memory_kb(pid_t process, const std::string& name) {
  const std::string status = content("/proc/" + std::to_string(process) + "/status");
  const auto at = status.find("\n" + name + ":");
  return at == std::string::npos ? 0.0 : std::strtod(status.c_str() + at + name.size() + 2, nullptr);
}

}  // namespace lukou::test
