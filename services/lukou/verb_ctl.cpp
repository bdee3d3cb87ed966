#include <cmath>
#include <cstdio>
#include <memory>

#include "common/process/address_options.hpp"
#include "common/process/environment.hpp"
#include "common/process/run_client.hpp"
#include "common/process/run_list.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

constexpr double kAnswer_s = 5.0;

struct CtlArguments {
  std::string run;
  bus::Address given{.domain = -1};
  std::vector<std::string> request;
};

void list() {
  const auto runs = process::list_runs();
  if (runs.empty()) std::fprintf(stderr, "no run on this host\n");
  for (const process::ListedRun& run : runs) {
    std::printf("%s domain %d%s%s\n", run.run.c_str(), run.domain, run.secured ? ", secured" : "",
                run.hosts ? ", on several hosts" : "");
  }
}

void print_state(const process::RunClient& client) {
  const RunState& state = *client.state();
  std::printf("%s: %s, %.1f of %.1f s recorded", state.run.c_str(), std::string(name(state.phase)).c_str(),
              time_s(std::max<Step>(state.recorded, 0)), time_s(state.end));
  if (client.view()) {
    const FigureColumns& all = client.view()->figures;
    const double mean_s = all.mean_stop_time_s.front();
    std::printf(", %u cars on the road, %u waiting, %u standing, mean stop time %.2f s", all.in_system.front(),
                all.waiting.front(), all.standing.front(), std::isnan(mean_s) ? 0.0 : mean_s);
  }
  if (state.foreign_samples > 0) {
    std::printf(", %llu samples of strangers ignored", static_cast<unsigned long long>(state.foreign_samples));
  }
  std::printf("%s%s\n", state.text.empty() ? "" : ", ", state.text.c_str());
  std::fflush(stdout);
}

/// Prints a line a second until the run ends (`once`: one line).
int watch(process::RunClient& client, bool once) {
  const double begin_s = process::wall_s();
  double printed_s = begin_s - 1.0;
  while (process::stop_signal() == 0) {
    client.poll(0.1);
    const double now_s = process::wall_s();
    if (!client.state()) {
      if (now_s - begin_s > kAnswer_s) return report_errors({"", "the run's clock does not answer"});
      continue;
    }
    const bool over = client.state()->phase >= RunPhase::kEnded || (now_s - begin_s > 1.0 && !client.connected());
    if (over || (once && (client.view() || now_s - begin_s > 1.0)) || (!once && now_s - printed_s >= 1.0)) {
      print_state(client);
      printed_s = now_s;
    }
    if (over || (once && printed_s == now_s)) return process::kExitDone;
  }
  return process::kExitInterrupted;
}

int ctl(const CtlArguments& arguments) {
  if (arguments.run == "list") {
    list();
    return process::kExitDone;
  }
  const auto run = process::find_run(arguments.run, arguments.given);
  if (!run) return report_errors(run.error());
  process::catch_stop_signals();
  auto client = process::RunClient::attach(run.value(), true);
  if (!client) return report_errors(client.error());
  std::string request;
  for (const std::string& word : arguments.request) request += (request.empty() ? "" : " ") + word;
  if (request.empty() || request == "status") return watch(*client.value(), true);
  if (request == "watch") return watch(*client.value(), false);
  const auto answer = client.value()->request(request, kAnswer_s);
  if (!answer) return report_errors(answer.error());
  std::printf("%s\n", answer.value().c_str());
  return process::kExitDone;
}

}  // namespace

Action add_ctl(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("ctl", "talk to a running simulation; `ctl list` names the runs");
  auto arguments = std::make_shared<CtlArguments>();
  verb->add_option("run", arguments->run, "id of the run, or its beginning; or `list`")->required();
  verb->add_option("request", arguments->request,
                   "pause [at S] | resume | step [N] | pace X | stop [at S] | set PATH=VALUE | status | watch");
  verb->add_option("--domain", arguments->given.domain, "DDS domain id, of a run that another host has started")
      ->envname("LUKOU_DOMAIN")
      ->check(CLI::Range(0, 230));
  process::add_address_options(*verb, arguments->given);
  return [arguments] { return ctl(*arguments); };
}

}  // namespace lukou
