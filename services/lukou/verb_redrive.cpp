#include <cinttypes>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/process/environment.hpp"
#include "common/results/table.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/redrive/redrive.hpp"
#include "services/lukou/report/progress.hpp"
#include "services/lukou/rsu_option.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

using redrive::Difference;

constexpr int kShown = 10;  ///< differences that are printed without --table

struct RedriveArguments {
  std::string result;
  std::vector<std::string> rsus;        ///< "COMMAND" for all RSUs, or "N=COMMAND"
  std::vector<std::string> algorithms;  ///< "NAME" for RSU 0, or "N=NAME"
  std::vector<std::string> sets;
  std::string table;
  bool json = false;
  bool quiet = false;
};

/// "car 1234 (rsu0, step 512, 51.2 s): advice: recorded -0.37 m/s2 ..., now release"
std::string text_of(const Difference& d) {
  char place[96];
  std::snprintf(place, sizeof place, "step %" PRId64 " (%.1f s), rsu%u, ", d.step, time_s(d.step), d.rsu);
  std::string text = place + std::string(name(d.topic.kind));
  if (d.topic.kind == redrive::Topic::Kind::kAdvice) {
    text += d.vehicle ? " for car " + std::to_string(*d.vehicle) : " for a car that did not speak in this step";
  }
  if (d.topic.kind == redrive::Topic::Kind::kLaneSpeed) {
    text += " for " + std::string(name(static_cast<Lane>(d.topic.id)));
  }
  const auto said = [](const std::string& what) { return what.empty() ? std::string("nothing") : what; };
  return text + ": recorded " + said(d.recorded) + ", now " + said(d.now);
}

/// Every difference, a row each.
class DifferenceTable {
 public:
  static Expected<DifferenceTable> create(const std::string& file) {
    auto table = results::TableWriter::create(file, "step,time_s,rsu,kind,vehicle,lane,recorded,now");
    if (!table) return table.error();
    return DifferenceTable(std::move(table).value());
  }
  void add(const Difference& d) {
    table_.whole(d.step);
    table_.tenths(d.step);
    table_.count(d.rsu);
    table_.name(name(d.topic.kind));
    d.vehicle ? table_.count(*d.vehicle) : table_.name("");
    const bool of_lane = d.topic.kind == redrive::Topic::Kind::kLaneSpeed;
    table_.name(of_lane ? name(static_cast<Lane>(d.topic.id)) : std::string_view());
    table_.name(d.recorded);
    table_.name(d.now);
    table_.end_row();
  }
  Expected<Done> close() { return table_.sync(); }

 private:
  explicit DifferenceTable(results::TableWriter table) : table_(std::move(table)) {}
  results::TableWriter table_;
};

void print(const redrive::Comparison& comparison, Step last) {
  std::printf("%" PRIu64 " steps compared, %" PRIu64 " differ\n", comparison.steps(), comparison.steps_differing());
  for (const auto& [rsu, step] : comparison.lost()) {
    if (step < last) std::printf("rsu%u was lost in step %" PRId64 " of the record: compared up to there\n", rsu, step);
  }
  std::printf("%-12s %12s %12s %14s %12s\n", "", "same", "changed", "record alone", "now alone");
  for (const auto& [kind, counts] : comparison.words()) {
    std::printf("%-12s %12" PRIu64 " %12" PRIu64 " %14" PRIu64 " %12" PRIu64 "\n", std::string(name(kind)).c_str(),
                counts.same, counts.changed, counts.missing, counts.added);
  }
  if (comparison.first()) std::printf("first difference: %s\n", text_of(*comparison.first()).c_str());
  std::printf("%s\n", comparison.same() ? "the same answers" : "other answers");
}

void print_json(const redrive::Comparison& comparison) {
  nlohmann::ordered_json json = {
      {"same", comparison.same()}, {"steps", comparison.steps()}, {"steps_differing", comparison.steps_differing()}};
  for (const auto& [kind, counts] : comparison.words()) {
    json["words"][std::string(name(kind))] = {
        {"same", counts.same}, {"changed", counts.changed}, {"missing", counts.missing}, {"added", counts.added}};
  }
  json["first"] = nullptr;
  if (const auto& first = comparison.first()) {
    json["first"] = {{"step", first->step},         {"rsu", first->rsu}, {"kind", name(first->topic.kind)},
                     {"recorded", first->recorded}, {"now", first->now}, {"text", text_of(*first)}};
    json["first"]["vehicle"] = first->vehicle ? nlohmann::ordered_json(*first->vehicle) : nullptr;
  }
  std::printf("%s\n", json.dump().c_str());
}

/// The recorded scenario with what the arguments change in it.
Expected<scenario::Resolved> scenario_of(const redrive::Tape& tape, const RedriveArguments& arguments) {
  std::vector<std::string> sets = arguments.sets;
  for (const std::string& text : arguments.algorithms) {
    const RsuOption option = rsu_option(text);
    sets.push_back("rsus[" + std::to_string(option.rsu.value_or(0)) + "].algorithm=" + option.value);
  }
  for (const std::string& set : sets) {
    if (!set.starts_with("rsus[")) {
      return Error{"--set " + set,
                   "only what stands under rsus[N] can differ: the roadside's input is the recorded one"};
    }
  }
  return scenario::load_text(tape.facts().scenario, "scenario of the record", "/", sets);
}

Expected<std::map<std::uint32_t, std::string>> commands_of(const RsuOptions& options, std::uint32_t rsus) {
  std::map<std::uint32_t, std::string> commands;
  for (std::uint32_t rsu = 0; rsu < rsus && !options.all.empty(); ++rsu) commands[rsu] = options.all;
  for (const auto& [rsu, command] : options.of) {
    if (rsu >= rsus)
      return Error{"--rsu " + std::to_string(rsu) + "=...", "the record has " + std::to_string(rsus) + " RSUs"};
    commands[rsu] = command;
  }
  return commands;
}

int run_redrive(const RedriveArguments& arguments) {
  process::catch_stop_signals();
  auto tape = redrive::Tape::open(arguments.result);
  if (!tape) return report_errors(tape.error());
  auto scenario = scenario_of(tape.value(), arguments);
  if (!scenario) return report_errors(scenario.error());
  const auto options = rsu_options("--rsu", arguments.rsus);
  if (!options) return report_errors(options.error());
  const auto commands = commands_of(options.value(), scenario::protocol(scenario.value()).rsus);
  if (!commands) return report_errors(commands.error());
  std::optional<DifferenceTable> table;
  if (!arguments.table.empty()) {
    auto created = DifferenceTable::create(arguments.table);
    if (!created) {
      report_errors(created.error());
      return process::kExitIo;
    }
    table.emplace(std::move(created).value());
  }
  int shown = 0;
  redrive::Comparison comparison([&](const Difference& difference) {
    if (table) table->add(difference);
    if (!table && !arguments.json && ++shown <= kShown) std::printf("%s\n", text_of(difference).c_str());
  });
  report::Progress progress;
  const double begin_s = process::wall_s();
  const Step last = tape.value().last();
  const redrive::Listener listener = [&](Step step) {
    if (arguments.quiet || step % 100 != 0) return;
    progress.show(
        {.run = "redrive", .phase = "running", .step = step, .end = last, .wall_s = process::wall_s() - begin_s});
  };
  const Expected<Done> done =
      commands.value().empty()
          ? redrive::in_process(tape.value(), scenario.value(), comparison, listener)
          : redrive::as_processes(tape.value(), scenario.value(), commands.value(), comparison, listener);
  if (!arguments.quiet) progress.finish();
  if (!done) {
    report_errors(done.error());
    return process::stop_signal() != 0 ? process::kExitInterrupted : process::kExitAborted;
  }
  if (table) {
    if (auto closed = table->close(); !closed) {
      report_errors(closed.error());
      return process::kExitIo;
    }
  }
  arguments.json ? print_json(comparison) : print(comparison, last);
  return comparison.same() ? process::kExitDone : process::kExitInternal;
}

}  // namespace

Action add_redrive(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "redrive", "feed the roadside's recorded input to another build of an RSU, and compare what it answers");
  auto arguments = std::make_shared<RedriveArguments>();
  verb->add_option("result", arguments->result, "result folder of a run with record.log=FULL")->required();
  const auto one_word = [&](const char* option, std::vector<std::string>& values, const char* help, const char* type) {
    verb->add_option(option, values, help)->type_size(1)->allow_extra_args(false)->type_name(type);
  };
  one_word("--rsu", arguments->rsus,
           "command that is the RSU; of all RSUs, or of RSU N; may be repeated [the shipped one]", "[N=]COMMAND");
  one_word("--rsu-algorithm", arguments->algorithms, "another shipped algorithm for RSU 0, or RSU N", "[N=]NAME");
  one_word("--set", arguments->sets, "PATH=VALUE under rsus[N]; may be repeated", "PATH=VALUE");
  verb->add_option("--table", arguments->table, "write every difference to this CSV file");
  verb->add_flag("--json", arguments->json, "one JSON object on standard output");
  verb->add_flag("--quiet", arguments->quiet, "no progress");
  return [arguments] { return run_redrive(*arguments); };
}

}  // namespace lukou
