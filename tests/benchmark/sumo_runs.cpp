#include "tests/benchmark/sumo_runs.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/benchmark/product_run.hpp"
#include "tests/benchmark/speed_runs.hpp"

namespace lukou::test {
namespace {

constexpr double kSecondsToCross = 300.0;  // car.csv has only cars that crossed the line
constexpr double kLimit_s = 3600.0;
constexpr const char* kSumo = "/usr/bin/sumo";

/// Standard output of a program that ended well; ends this program with code 1 otherwise.
std::string output_of(const std::string& name, Program& program) {
  const int code = program.wait(kLimit_s);
  if (code == 0) return program.out();
  std::fprintf(stderr, "%s ended with code %d\n%s%s", name.c_str(), code, program.out().c_str(), program.err().c_str());
  std::exit(1);
}

std::string pinned(int core, std::vector<std::string> words) {
  words.insert(words.begin(), {"-c", std::to_string(core)});
  Program program(words, {}, "/usr/bin/taskset");
  return output_of(words[2], program);
}

/// The number behind `label` in what SUMO printed.
double number_behind(const std::string& text, const std::string& label) {
  const auto at = text.find(label);
  if (at == std::string::npos) {
    std::fprintf(stderr, "sumo did not print '%s':\n%s", label.c_str(), text.c_str());
    std::exit(1);
  }
  return std::strtod(text.c_str() + at + label.size(), nullptr);
}

}  // namespace

std::string SumoPeer::missing() {
  const std::string remedy = "; launch_scripts/setup.sh --bench installs and builds it";
  if (!std::filesystem::exists(kSumo)) return "package sumo is missing" + remedy;
  for (const char* client : {LUKOU_SUMO_OVER_TRACI, LUKOU_SUMO_IN_PROCESS})
    if (!std::filesystem::exists(client)) return "the client of SUMO is not built" + remedy;
  return "";
}

SumoPeer::SumoPeer(double duration_s) : duration_s_(duration_s) {
  const std::string result = folder_ / "result";
  auto arguments = speed_arguments("in-process", duration_s + kSecondsToCross);
  arguments.insert(arguments.end(), {"--out", result});
  Program run(arguments);
  report_of(run, run.wait(kLimit_s));
  Program writer({LUKOU_SUMO_PEER, result + "/car.csv", std::to_string(duration_s), folder_ / "."}, {},
                 "/usr/bin/python3");
  output_of("sumo_peer.py", writer);
}

std::vector<std::string> SumoPeer::sumo_words() const {
  return {kSumo,
          "--net-file",
          folder_ / "paper.net.xml",
          "--route-files",
          folder_ / "cars.rou.xml",
          "--tripinfo-output",
          folder_ / "trips.xml",
          "--step-length",
          "0.1",
          "--seed",
          "1",
          "--time-to-teleport",
          "-1",
          "--xml-validation",
          "never",
          "--no-step-log",
          "--no-warnings"};
}

SumoPeer::Guided SumoPeer::guided(const std::string& client, int core) const {
  std::vector<std::string> words = {client, std::to_string(duration_s_)};
  const auto sumo = sumo_words();
  words.insert(words.end(), sumo.begin(), sumo.end());
  const std::string text = pinned(core, words);
  // Over TraCI, SUMO prints on the same stream before.
  const nlohmann::json said =
      nlohmann::json::parse(text.substr(std::min(text.rfind('{'), text.size())), nullptr, false);
  if (!said.is_object()) {
    std::fprintf(stderr, "%s printed no figures:\n%s", client.c_str(), text.c_str());
    std::exit(1);
  }
  return {said["steps_per_s"].get<double>(), said["commands_per_step"].get<double>(), said["arrived"].get<double>()};
}

SumoPeer::Guided SumoPeer::over_traci(int core) const { return guided(LUKOU_SUMO_OVER_TRACI, core); }

SumoPeer::Guided SumoPeer::in_process(int core) const { return guided(LUKOU_SUMO_IN_PROCESS, core); }

SumoPeer::Alone SumoPeer::alone(int core) const {
  auto words = sumo_words();
  words.insert(words.end(), {"--end", std::to_string(duration_s_), "--duration-log.statistics"});
  const std::string text = pinned(core, words);
  const double steps = duration_s_ * 10.0;
  return {steps / number_behind(text, "Duration: "), number_behind(text, "UPS: ")};
}

}  // namespace lukou::test
