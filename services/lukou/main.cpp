#include <utility>
#include <vector>

#include "common/core/version.hpp"
#include "common/process/stepping.hpp"
#include "services/lukou/verbs.hpp"

using namespace lukou;

namespace {

int run(int argc, char** argv) {
  CLI::App app("Lukou: one signalised intersection under vehicle-road cooperation, as processes on a bus");
  app.set_version_flag("--version", std::string(version()));
  app.require_subcommand(1);
  const std::vector<Action (*)(CLI::App&)> verbs = {
      add_run,    add_verify,  add_validate, add_inspect, add_ctl,  add_doctor, add_algorithms, add_new,  add_why,
      add_replay, add_redrive, add_keys,     add_leash,   add_plot, add_report, add_export,     add_sweep};
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const auto add : verbs) {
    Action action = add(app);
    actions.emplace_back(app.get_subcommands([](CLI::App*) { return true; }).back(), std::move(action));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? process::kExitDone : process::kExitUsage;
  }
  for (const auto& [verb, action] : actions)
    if (verb->parsed()) return action();
  return process::kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("lukou", [&] { return run(argc, argv); });
}
