#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "services/lukou/report/progress.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/study/disk_budget.hpp"
#include "services/lukou/study/sweep.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

namespace fs = std::filesystem;
using studies::RunRecord;

struct SweepArguments {
  std::string study;
  std::vector<std::string> sets;
  std::uint32_t seeds = 0;  ///< 0: those of the study
  int jobs = 0;             ///< 0: as many as there are processors
  std::string out;
  bool resume = false;
  bool json = false;
  bool quiet = false;
};

int refuse(const Error& error, int exit_code) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return exit_code;
}

/// The folder that the sweep works in, new or begun before.
Expected<studies::StudyFolder> folder_of(const SweepArguments& arguments) {
  const studies::Additions additions{arguments.sets,
                                     arguments.seeds > 0 ? std::optional(arguments.seeds) : std::nullopt};
  if (studies::StudyFolder::is_one(arguments.study)) {
    if (!arguments.resume) return Error{arguments.study, "is a study's folder already; add --resume to finish it"};
    return studies::StudyFolder::open(arguments.study);
  }
  auto study = studies::load(arguments.study, additions);
  if (!study) return study.error();
  const fs::path out = arguments.out.empty() ? fs::path("result") / study.value().name : fs::path(arguments.out);
  if (!studies::StudyFolder::is_one(out)) return studies::StudyFolder::create(out, std::move(study).value());
  if (!arguments.resume) {
    return Error{out.string(), "holds this study already; add --resume to finish it, or give another --out"};
  }
  auto folder = studies::StudyFolder::open(out);
  if (!folder) return folder;
  if (auto same = folder.value().extend(study.value()); !same) return same.error();
  return folder;
}

/// "57 of 295 runs, 2 failed, 12:31 left"
std::string figures(const studies::SweepNews& news) {
  std::string text = std::to_string(news.done) + " of " + std::to_string(news.total) + " runs";
  if (news.failed > 0) text += ", " + std::to_string(news.failed) + " failed";
  if (news.anomalies > 0) text += ", " + std::to_string(news.anomalies) + " ended by an anomaly";
  if (news.done == news.total) return text + ", " + report::duration_text(news.wall_s);
  return news.done == 0 ? text : text + ", " + report::duration_text(news.left_s) + " left";
}

/// What a sweep says at its end.
nlohmann::ordered_json summary_of(const studies::StudyFolder& folder, const studies::Outcome& outcome, int exit_code) {
  const auto count = [&](RunRecord::State state) { return outcome.gathered.count(state); };
  nlohmann::ordered_json json = {{"exit_code", exit_code},
                                 {"folder", folder.path().string()},
                                 {"study", folder.study().name},
                                 {"points", folder.plan().points.size()},
                                 {"runs_done", count(RunRecord::State::kDone)},
                                 {"runs_anomaly", count(RunRecord::State::kAnomaly)},
                                 {"runs_failed", count(RunRecord::State::kFailed)},
                                 {"runs_missing", count(RunRecord::State::kMissing)}};
  for (const auto& [key, said] : {std::pair("findings", &outcome.findings), std::pair("warnings", &outcome.warnings)}) {
    json[key] = nlohmann::ordered_json::array();
    for (const studies::Sentence& sentence : *said) json[key].push_back(sentence.text);
  }
  return json;
}

void print_failures(const studies::StudyFolder& folder, const studies::Gathered& gathered) {
  constexpr int kMost = 10;
  int shown = 0;
  for (const auto& runs : gathered.points)
    for (const RunRecord& run : runs) {
      if (run.state != RunRecord::State::kFailed || ++shown > kMost) continue;
      std::fprintf(stderr, "failed: %s: %s\n", folder.log(run.key).c_str(), run.what.c_str());
    }
  if (shown > kMost) std::fprintf(stderr, "... and %d more\n", shown - kMost);
}

/// The findings about the first measure and those about none; the report has them all.
void print_outcome(const studies::StudyFolder& folder, const studies::Outcome& outcome) {
  const std::string& first = outcome.analysis.measures.front().label;
  std::size_t left_out = 0;
  for (const studies::Sentence& sentence : outcome.findings) {
    if (sentence.about == first || sentence.about == "pairing") {
      std::fprintf(stderr, "- %s\n", sentence.text.c_str());
    } else {
      ++left_out;
    }
  }
  if (left_out > 0) std::fprintf(stderr, "- ... and %zu findings about other measures\n", left_out);
  for (const studies::Sentence& sentence : outcome.warnings) {
    std::fprintf(stderr, "warning: %s\n", sentence.text.c_str());
  }
  print_failures(folder, outcome.gathered);
  std::fprintf(stderr, "results: %s\n", folder.path().c_str());
}

int sweep(const SweepArguments& arguments) {
  auto opened = folder_of(arguments);
  if (!opened) return refuse(opened.error(), process::kExitUsage);
  const studies::StudyFolder& folder = opened.value();
  if (auto alone = folder.lock(); !alone) return refuse(alone.error(), process::kExitUsage);
  process::catch_stop_signals();

  const int cores = static_cast<int>(studies::usable_cores().size());
  const int jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, cores);
  const auto make = [&](const studies::StudyFolder& in, const std::vector<studies::RunKey>& runs) -> Expected<int> {
    std::string room;
    if (auto fits = studies::check_disk(in, runs, jobs, room); !fits) return fits.error();
    if (!arguments.quiet) {
      std::fprintf(stderr, "%s: %zu points, %zu runs to make, %d at a time; %s\n", in.study().name.c_str(),
                   in.plan().points.size(), runs.size(), jobs, room.c_str());
    }
    report::Progress progress;
    studies::SweepListener listener;
    if (!arguments.quiet) {
      listener = [&](const studies::SweepNews& news) {
        progress.show(in.study().name, static_cast<double>(news.done) / static_cast<double>(news.total), figures(news));
      };
    }
    auto made = studies::run_all(in, runs, {.jobs = jobs, .pin = jobs <= cores}, listener);
    progress.finish();
    return made;
  };
  const auto stopped = studies::make_missing_runs(folder, make);
  if (!stopped) return refuse(stopped.error(), process::kExitIo);

  const auto outcome = studies::write_report(folder);
  if (!outcome) return refuse(outcome.error(), process::kExitIo);
  int exit_code = process::kExitDone;
  if (outcome.value().gathered.count(RunRecord::State::kFailed) > 0) exit_code = process::kExitFailedRuns;
  if (stopped.value() != 0)
    exit_code = stopped.value() == SIGINT ? process::kExitInterrupted : process::kExitTerminated;
  if (!arguments.quiet) print_outcome(folder, outcome.value());
  if (stopped.value() != 0) {
    std::fprintf(stderr, "interrupted; `lukou sweep %s --resume` makes the runs that are missing\n",
                 folder.path().c_str());
  }
  if (arguments.json) std::printf("%s\n", summary_of(folder, outcome.value(), exit_code).dump().c_str());
  return exit_code;
}

}  // namespace

Action add_sweep(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("sweep", "run a study: many runs over seeds and parameters, and what they say");
  auto arguments = std::make_shared<SweepArguments>();
  verb->add_option("study", arguments->study,
                   "a study file, the name of a shipped one (robustness), or a study's folder")
      ->required();
  verb->add_option("--set", arguments->sets, "PATH=VALUE for all runs, after the study's own; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("PATH=VALUE");
  verb->add_option("--seeds", arguments->seeds, "how many seeds, in place of the study's seeds.count")
      ->check(CLI::Range(1, 100000));
  verb->add_option("--jobs", arguments->jobs, "runs at a time [as many as there are processors]")
      ->check(CLI::Range(1, 4096));
  verb->add_option("--out", arguments->out, "the study's folder: must not exist, or be empty [result/<study>]");
  verb->add_flag("--resume", arguments->resume, "make what is missing or has failed");
  verb->add_flag("--json", arguments->json, "one JSON object on standard output");
  verb->add_flag("--quiet", arguments->quiet, "no progress, no findings");
  return [arguments] { return sweep(*arguments); };
}

}  // namespace lukou
