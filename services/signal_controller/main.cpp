#include <optional>

#include "common/process/options.hpp"
#include "common/process/stepping.hpp"
#include "common/scenario/actuation.hpp"
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
  member.faces(Topic::kSignal, signals);

  const auto welcome = member.join();
  if (!welcome) return process::report_start(welcome.error(), process::kExitUsage);
  auto scenario = scenario::load_text(welcome.value(), "welcome", "/");
  if (!scenario) return process::report_start(scenario.error(), process::kExitUsage);

  const auto actuation = scenario::actuation(scenario.value().message());
  SignalControllerNode node(scenario::signal_plan(scenario.value()).value(), scenario::signal_promise(scenario.value()),
                            actuation);
  // A fixed plan hears no requests: nobody pays for them.
  std::optional<bus::Reader<RequestBatch>> requests_in;
  std::vector<Edge<RequestBatch>> requests;
  if (actuation) {
    requests_in.emplace(member.participant());
    member.faces(Topic::kRequest, *requests_in);
    requests.assign(scenario::protocol(scenario.value()).rsus, Edge<RequestBatch>(kStepBefore));
  }
  SignalBatch batch;
  process::run_steps(
      member,
      [&] {
        if (!requests_in) return;
        process::hear(member, *requests_in, [&](RequestBatch& asked, const bus::SampleInfo& info) -> Expected<Done> {
          if (rsu_role(asked.rsu) != member.role_of(info.producer)) {
            return Error{"", "says it is of " + rsu_role(asked.rsu)};
          }
          return requests.at(asked.rsu).accept(info.epoch, asked);
        });
      },
      [&](Step k) {
        for (std::uint32_t rsu = 0; rsu < requests.size(); ++rsu)
          if (!requests[rsu].ready(k)) return rsu_role(rsu);
        return std::string();
      },
      [&](Step k) {
        for (Edge<RequestBatch>& edge : requests) {
          if (const RequestBatch* asked = edge.take(k)) node.hear(k, *asked);
        }
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
