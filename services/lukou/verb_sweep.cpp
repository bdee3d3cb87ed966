#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "services/lukou/launch/cores.hpp"
#include "services/lukou/report/progress.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/study/disk_budget.hpp"
#include "services/lukou/study/slurm.hpp"
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
  bool slurm = false;
  int array_size = 20;
  std::vector<std::string> slurm_options;
  bool detach = false;
  std::string task;  ///< list of runs; set in a task of a job array
  bool json = false;
  bool quiet = false;
};

int refuse(const Error& error, int exit_code) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return exit_code;
}

int exit_code_of(int signal) { return signal == SIGINT ? process::kExitInterrupted : process::kExitTerminated; }

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

/// The progress of one round of runs.
class RoundProgress {
 public:
  RoundProgress(const SweepArguments& arguments, const std::string& name) : quiet_(arguments.quiet), name_(name) {}
  ~RoundProgress() { progress_.finish(); }
  RoundProgress(const RoundProgress&) = delete;
  RoundProgress& operator=(const RoundProgress&) = delete;

  studies::SweepListener listener() {
    if (quiet_) return {};
    return [this](const studies::SweepNews& news) {
      progress_.show(name_, static_cast<double>(news.done) / static_cast<double>(news.total), figures(news));
    };
  }

 private:
  bool quiet_;
  std::string name_;
  report::Progress progress_;
};

/// Makes runs on this computer.
studies::MakeRuns made_here(const SweepArguments& arguments) {
  return [&arguments](const studies::StudyFolder& folder, const std::vector<studies::RunKey>& runs) -> Expected<int> {
    const int cores = static_cast<int>(launch::usable_cores().size());
    const int jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, cores);
    std::string room;
    if (auto fits = studies::check_disk(folder, runs, jobs, room); !fits) return fits.error();
    if (!arguments.quiet) {
      std::fprintf(stderr, "%s: %zu points, %zu runs to make, %d at a time; %s\n", folder.study().name.c_str(),
                   folder.plan().points.size(), runs.size(), jobs, room.c_str());
    }
    RoundProgress progress(arguments, folder.study().name);
    return studies::run_all(folder, runs, {.jobs = jobs, .pin = jobs <= cores}, progress.listener());
  };
}

/// Hands runs to Slurm. Returns what they became, or the error; nothing is said of what they will give.
Expected<studies::SlurmJobs> submitted(const SweepArguments& arguments, const studies::StudyFolder& folder,
                                       const std::vector<studies::RunKey>& runs) {
  std::string room;
  if (auto fits = studies::check_disk(folder, runs, arguments.array_size, room); !fits) return fits.error();
  auto jobs = studies::submit(folder, runs, {.array_size = arguments.array_size, .options = arguments.slurm_options});
  if (jobs && !arguments.quiet) {
    std::fprintf(stderr, "%s: %zu points, %zu runs to make, Slurm job array %s, gathered by job %s; %s\n",
                 folder.study().name.c_str(), folder.plan().points.size(), runs.size(), jobs.value().array.c_str(),
                 jobs.value().gathering.c_str(), room.c_str());
  }
  return jobs;
}

/// Makes runs on a cluster and waits for them.
studies::MakeRuns made_by_slurm(const SweepArguments& arguments) {
  return [&arguments](const studies::StudyFolder& folder, const std::vector<studies::RunKey>& runs) -> Expected<int> {
    const auto jobs = submitted(arguments, folder, runs);
    if (!jobs) return jobs.error();
    RoundProgress progress(arguments, folder.study().name);
    const auto stopped = studies::follow(folder, jobs.value(), runs, progress.listener());
    if (stopped && stopped.value() != 0) {
      std::fprintf(stderr, "\njobs %s and %s go on; `scancel %s %s` would end them\n", jobs.value().array.c_str(),
                   jobs.value().gathering.c_str(), jobs.value().array.c_str(), jobs.value().gathering.c_str());
    }
    return stopped;
  };
}

/// A task of a job array: its share of the runs, one after the other.
int work_on_task(const SweepArguments& arguments) {
  const auto folder = studies::StudyFolder::open(arguments.study);
  if (!folder) return refuse(folder.error(), process::kExitUsage);
  const auto runs = studies::runs_of_task(folder.value(), arguments.task);
  if (!runs) return refuse(runs.error(), process::kExitUsage);
  process::catch_stop_signals();
  // Where a task runs is Slurm's business.
  const auto stopped = studies::run_all(folder.value(), runs.value(), {.jobs = 1, .pin = false}, {});
  if (!stopped) return refuse(stopped.error(), process::kExitIo);
  if (stopped.value() != 0) return exit_code_of(stopped.value());
  const bool failed = std::ranges::any_of(runs.value(), [&](const studies::RunKey& run) {
    const auto marker = folder.value().marker(run);
    return !marker || marker->failed();
  });
  return failed ? process::kExitFailedRuns : process::kExitDone;
}

/// Hands what is missing to Slurm and leaves.
int detach(const SweepArguments& arguments, const studies::StudyFolder& folder) {
  const auto gathered = studies::gather(folder);
  if (!gathered) return refuse(gathered.error(), process::kExitIo);
  const auto runs = studies::missing_runs(gathered.value());
  if (runs.empty()) return process::kExitDone;
  const auto jobs = submitted(arguments, folder, runs);
  return jobs ? int{process::kExitDone} : refuse(jobs.error(), process::kExitIo);
}

int sweep(const SweepArguments& arguments) {
  if (!arguments.task.empty()) return work_on_task(arguments);
  auto opened = folder_of(arguments);
  if (!opened) return refuse(opened.error(), process::kExitUsage);
  const studies::StudyFolder& folder = opened.value();
  if (auto alone = folder.lock(); !alone) return refuse(alone.error(), process::kExitUsage);
  process::catch_stop_signals();
  if (arguments.detach) return detach(arguments, folder);
  const auto stopped =
      studies::make_missing_runs(folder, arguments.slurm ? made_by_slurm(arguments) : made_here(arguments));
  if (!stopped) return refuse(stopped.error(), process::kExitIo);

  const auto outcome = studies::write_report(folder);
  if (!outcome) return refuse(outcome.error(), process::kExitIo);
  const studies::Gathered& gathered = outcome.value().gathered;
  const bool whole = gathered.count(RunRecord::State::kFailed) == 0 && gathered.count(RunRecord::State::kMissing) == 0;
  int exit_code = whole ? process::kExitDone : process::kExitFailedRuns;
  if (stopped.value() != 0) exit_code = exit_code_of(stopped.value());
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
  CLI::Option* slurm = verb->add_flag("--slurm", arguments->slurm, "as a job array of a Slurm cluster");
  verb->add_option("--array-size", arguments->array_size,
                   "tasks of the job array, each with its share of the runs [20]")
      ->needs(slurm)
      ->check(CLI::Range(1, 1000));
  verb->add_option("--slurm-option", arguments->slurm_options, "option for sbatch: --partition=day; may be repeated")
      ->needs(slurm)
      ->type_size(1)
      ->allow_extra_args(false);
  verb->add_flag("--detach", arguments->detach, "submit and leave; the last job of the array gathers")->needs(slurm);
  // What the tasks of the array are started with.
  verb->add_option("--task", arguments->task)->group("");
  verb->add_flag("--json", arguments->json, "one JSON object on standard output");
  verb->add_flag("--quiet", arguments->quiet, "no progress, no findings");
  return [arguments] { return sweep(*arguments); };
}

}  // namespace lukou
