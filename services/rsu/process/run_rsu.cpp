#include "services/rsu/process/run_rsu.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "common/process/options.hpp"
#include "common/process/stepping.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/rsu/process/rsu_setup.hpp"
#include "services/rsu/rsu_config.hpp"
#include "services/rsu/rsu_node.hpp"

namespace lukou {
namespace {

using MakeScenarioAlgorithm = std::function<Expected<std::unique_ptr<RsuAlgorithm>>(const RsuConfig&)>;

int joined_run(int argc, char** argv, const MakeScenarioAlgorithm& make) {
  const auto options = process::member_options(
      argc, argv, "A roadside unit of a run.",
      {process::kNoWatchdog, {"--index", "which of the scenario's RSUs; default LUKOU_RSU, or 0"}});
  if (!options) return std::stoi(options.error().what);
  process::catch_terminate_signal();
  std::string index_text = options.value().value("--index");
  if (const char* given = std::getenv("LUKOU_RSU"); index_text.empty()) index_text = given == nullptr ? "0" : given;
  const std::string role = "rsu" + index_text;
  const int index = rsu_index(role);
  if (index < 0)
    return process::report_start({"--index", "must be a number, not `" + index_text + "`"}, process::kExitUsage);
  auto created = process::Member::create(
      {.role = role, .address = options.value().address, .watchdog = !options.value().has("--no-watchdog")});
  if (!created) return process::report_start(created.error(), process::kExitAborted);
  process::Member& member = *created.value();
  bus::Writer<RoadsideBatch> roadside_out(member.participant());
  bus::Reader<AirBatch> air_in(member.participant());
  bus::Reader<SignalBatch> signal_in(member.participant());
  member.faces(Topic::kRoadside, roadside_out);
  member.faces(Topic::kAir, air_in);
  member.faces(Topic::kSignal, signal_in);

  const auto welcome = member.join();
  if (!welcome) return process::report_start(welcome.error(), process::kExitUsage);
  auto scenario = scenario::load_text(welcome.value(), "welcome", "/");
  if (!scenario) return process::report_start(scenario.error(), process::kExitUsage);
  const auto config = rsu_config(scenario.value().message(), static_cast<std::uint32_t>(index));
  if (!config) return process::report_start(config.error(), process::kExitUsage);
  auto algorithm = make(config.value());
  if (!algorithm) return process::report_start(algorithm.error(), process::kExitUsage);

  std::optional<bus::Writer<RequestBatch>> requests_out;
  if (config.value().actuation) {
    requests_out.emplace(member.participant());
    member.faces(Topic::kRequest, *requests_out);
  }
  RsuNode node(config.value(), std::move(algorithm).value());
  node.measure_with(process::wall_s);
  // A returning RSU learns with its first grant which batches it begins with.
  const bool from_the_start = member.epoch() == 1;
  bool begun = from_the_start;
  Edge<AirBatch> air(kSameStep, from_the_start);
  Edge<SignalBatch> signal(signal_timing(scenario::signal_promise(scenario.value())), from_the_start);
  RoadsideBatch answer;
  answer.epoch = member.epoch();
  process::run_steps(
      member,
      [&] {
        const auto checked = [&](const Expected<Done>& done) {
          if (!done) process::give_up(member, role, done.error());
        };
        if (!begun && member.first_step()) {
          begun = true;
          checked(air.begin(*member.first_step()));
          checked(signal.begin(*member.first_step()));
        }
        process::hear(member, air_in,
                      [&](AirBatch& batch, const bus::SampleInfo& info) { return air.accept(info.epoch, batch); });
        process::hear(member, signal_in, [&](SignalBatch& batch, const bus::SampleInfo& info) {
          return signal.accept(info.epoch, batch);
        });
      },
      [&](Step k) {
        if (!air.ready(k)) return std::string(kEngineRole);
        return signal.ready(k) ? std::string() : std::string(kControllerRole);
      },
      [&](Step k) {
        if (scenario::apply(scenario.value(), member.due(k))) {
          node.change(rsu_config(scenario.value().message(), static_cast<std::uint32_t>(index)).value());
        }
        node.step(k, signal.take(k), *air.take(k), answer);
        roadside_out.write(answer, member.epoch());
        if (requests_out) requests_out->write(node.request(), member.epoch());
      });
  return process::report_end(member.end());
}

int run_with(int argc, char** argv, const MakeAlgorithm& make) {
  return joined_run(argc, argv, [&](const RsuConfig& config) -> Expected<std::unique_ptr<RsuAlgorithm>> {
    return make(setup_of(config));
  });
}

}  // namespace

RsuSetup setup_of(const RsuConfig& config) {
  return {.index = config.rsu, .map = map_view(config), .acceleration_max_mps2 = config.acceleration_max_mps2};
}

int run_rsu(int argc, char** argv, const MakeAlgorithm& make) {
  return process::guarded("rsu", [&] { return run_with(argc, argv, make); });
}

int run_rsu_throwing(int argc, char** argv, const MakeAlgorithm& make) {
  process::set_log_name("rsu");
  return run_with(argc, argv, make);
}

int run_shipped_rsu(int argc, char** argv) {
  return process::guarded("rsu", [&] {
    return joined_run(argc, argv,
                      [](const RsuConfig& config) { return make_algorithm(config.algorithm, config.parameters); });
  });
}

}  // namespace lukou
