#include <algorithm>

#include "common/process/options.hpp"
#include "common/process/stepping.hpp"
#include "common/scenario/directive_log.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/traffic_engine/engine_node.hpp"

using namespace lukou;

namespace {

/// Joins a run as its traffic engine and executes its steps.
int run(int argc, char** argv) {
  const auto options = process::member_options(
      argc, argv, "Every vehicle of a run.",
      {process::kNoWatchdog, {"--replay-directives", "directives.textproto of an earlier run"}});
  if (!options) return std::stoi(options.error().what);
  process::catch_terminate_signal();
  const std::string role(kEngineRole);
  auto created = process::Member::create(
      {.role = role, .address = options.value().address, .watchdog = !options.value().has("--no-watchdog")});
  if (!created) return process::report_start(created.error(), process::kExitAborted);
  process::Member& member = *created.value();
  bus::Writer<TrafficBatch> traffic_out(member.participant());
  bus::Writer<AirBatch> air_out(member.participant());
  bus::Reader<SignalBatch> signal_in(member.participant());
  bus::Reader<RoadsideBatch> roadside_in(member.participant());
  member.faces(Topic::kTraffic, traffic_out);
  member.faces(Topic::kAir, air_out);
  member.faces(Topic::kSignal, signal_in);
  member.faces(Topic::kRoadside, roadside_in);

  const auto welcome = member.join();
  if (!welcome) return process::report_start(welcome.error(), process::kExitUsage);
  auto scenario = scenario::load_text(welcome.value(), "welcome", "/");
  if (!scenario) return process::report_start(scenario.error(), process::kExitUsage);
  const auto config = engine_config(scenario.value());
  if (!config) return process::report_start(config.error(), process::kExitUsage);
  const scenario::Protocol protocol = scenario::protocol(scenario.value());

  EngineNode node(config.value());
  if (options.value().has("--replay-directives")) {
    const auto log = scenario::load_directives(options.value().value("--replay-directives"));
    if (!log) return process::report_start(log.error(), process::kExitUsage);
    node.replay(log.value().computed);
  }
  Edge<SignalBatch> signal(signal_timing(protocol.signal_promise));
  std::vector<Edge<RoadsideBatch>> roadside(protocol.rsus, Edge<RoadsideBatch>(kStepBefore));
  member.on_fence([&](std::uint32_t rsu, std::uint32_t epoch) { return roadside.at(rsu).fence(epoch); });
  member.on_attach([&](std::uint32_t rsu, std::uint32_t epoch, Step from) {
    if (auto done = roadside.at(rsu).attach(epoch, from); !done) process::give_up(member, role, done.error());
  });

  TrafficBatch traffic;
  AirBatch air;
  std::vector<const RoadsideBatch*> heard(protocol.rsus);
  process::run_steps(
      member,
      [&] {
        process::hear(member, signal_in, [&](SignalBatch& batch, const bus::SampleInfo& info) {
          return signal.accept(info.epoch, batch);
        });
        process::hear(member, roadside_in, [&](RoadsideBatch& batch, const bus::SampleInfo& info) -> Expected<Done> {
          if (rsu_role(batch.rsu) != member.role_of(info.producer)) {
            return Error{"", "says it is of " + rsu_role(batch.rsu)};
          }
          return roadside.at(batch.rsu).accept(info.epoch, batch);
        });
      },
      [&](Step k) {
        if (!signal.ready(k)) return std::string(kControllerRole);
        for (std::uint32_t rsu = 0; rsu < protocol.rsus; ++rsu)
          if (!roadside[rsu].ready(k)) return rsu_role(rsu);
        return std::string();
      },
      [&](Step k) {
        if (scenario::apply(scenario.value(), member.due(k))) node.change(engine_config(scenario.value()).value());
        for (std::uint32_t rsu = 0; rsu < protocol.rsus; ++rsu) heard[rsu] = roadside[rsu].take(k);
        if (auto done = node.step(k, signal.take(k), heard, traffic, air); !done) {
          return process::give_up(member, role, done.error());
        }
        air_out.write(air, member.epoch());
        traffic_out.write(traffic, member.epoch());
      });
  return process::report_end(member.end());
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("traffic-engine", [&] { return run(argc, argv); });
}
