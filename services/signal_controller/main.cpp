#include "common/process/options.hpp"
#include "common/process/stepping.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/signal_controller/signal_controller_node.hpp"

using namespace lukou;

namespace {

int run(int argc, char** argv) {
  const auto options = process::member_options(argc, argv, "Every signal head of a run.", {process::kNoWatchdog});
  if (!options) return std::stoi(options.error().what);
  process::catch_terminate_signal();
  const std::string role(kControllerRole);
  auto created = process::Member::create(
      {.role = role, .address = options.value().address, .watchdog = !options.value().has("--no-watchdog")});
  if (!created) return process::report_start(created.error(), process::kExitAborted);
  process::Member& member = *created.value();
  bus::Writer<SignalBatch> signals(member.participant());
  member.faces(Topic::kSignal, signals, true);

  const auto welcome = member.join();
  if (!welcome) return process::report_start(welcome.error(), process::kExitUsage);
  auto scenario = scenario::load_text(welcome.value(), "welcome", "/");
  if (!scenario) return process::report_start(scenario.error(), process::kExitUsage);

  SignalControllerNode node(scenario::signal_plan(scenario.value()).value(),
                            scenario::signal_promise(scenario.value()));
  SignalBatch batch;
  process::run_steps(
      member, [] {}, [](Step) { return std::string(); },
      [&](Step k) {
        if (scenario::apply(scenario.value(), member.due(k))) {
          node.use_plan(scenario::signal_plan(scenario.value()).value(), k);
        }
        if (node.step(k, batch)) signals.write(batch, member.epoch());
      });
  return process::report_end(member.end());
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("signal-controller", [&] { return run(argc, argv); });
}
