#include "services/lukou/study/slurm.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>

#include "common/process/environment.hpp"
#include "common/results/result_folder.hpp"
#include "services/lukou/launch/shell_word.hpp"

namespace lukou::studies {
namespace {

namespace fs = std::filesystem;

using launch::shell_word;

constexpr const char* kJobsFile = "jobs.txt";
constexpr const char* kGathered = "gathered";
constexpr double kLookEvery_s = 1.0;
constexpr double kAskEvery_s = 10.0;  ///< Slurm's controller

/// What a command of Slurm prints, without the last line end; or what went wrong.
Expected<std::string> answer_of(const std::vector<std::string>& command) {
  std::string line;
  for (const std::string& word : command) line += shell_word(word) + " ";
  struct Close {
    void operator()(std::FILE* pipe) const { pclose(pipe); }
  };
  std::unique_ptr<std::FILE, Close> pipe(popen((line + "2>&1").c_str(), "r"));
  if (!pipe) return Error{command.front(), "cannot be started"};
  std::string said;
  std::array<char, 4096> piece{};
  while (const std::size_t read = std::fread(piece.data(), 1, piece.size(), pipe.get()))
    said.append(piece.data(), read);
  while (!said.empty() && said.back() == '\n') said.pop_back();
  const int status = pclose(pipe.release());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return Error{command.front(), said.empty() ? "failed" : said};
  return said;
}

/// Whether one of the jobs is pending, running or about to end.
Expected<bool> are_at_work(const std::string& jobs) {
  const auto listed = answer_of({"squeue", "--noheader", "--jobs=" + jobs, "--format=%i %T"});
  if (listed) return !listed.value().empty();
  // A job that Slurm has forgotten is over.
  if (listed.error().what.find("Invalid job id") != std::string::npos) return false;
  return listed.error();
}

/// A folder for this submission: 1, 2, ...
Expected<fs::path> next_folder(const fs::path& base) {
  std::error_code code;
  for (int number = 1;; ++number) {
    const fs::path folder = base / std::to_string(number);
    if (fs::create_directories(folder, code)) return folder;
    if (code) return Error{folder.string(), "cannot be made: " + code.message()};
  }
}

Expected<Done> check_earlier(const fs::path& base) {
  const auto earlier = scenario::read_file(base / kJobsFile);
  if (!earlier) return Done{};
  std::string jobs = earlier.value();
  std::erase(jobs, '\n');
  const auto at_work = are_at_work(jobs);
  if (!at_work) return at_work.error();
  if (!at_work.value()) return Done{};
  return Error{base.string(),
               "jobs " + jobs + " of an earlier submission are still at work; wait for them, or scancel them"};
}

Expected<std::string> submit_script(const fs::path& script, const std::vector<std::string>& more) {
  std::vector<std::string> command = {"sbatch", "--parsable"};
  command.insert(command.end(), more.begin(), more.end());
  command.push_back(script.string());
  auto answer = answer_of(command);
  if (!answer) return answer;
  // "12" or "12;cluster", perhaps below a warning.
  std::string id = answer.value().substr(answer.value().rfind('\n') + 1);
  return id.substr(0, id.find(';'));
}

}  // namespace

Expected<SlurmJobs> submit(const StudyFolder& folder, const std::vector<RunKey>& runs, const SlurmOptions& options) {
  const fs::path base = folder.path() / "slurm";
  if (auto free = check_earlier(base); !free) return free.error();
  const auto made = next_folder(base);
  if (!made) return made.error();
  SlurmJobs jobs{.array = {}, .gathering = {}, .folder = made.value()};

  const std::size_t tasks = std::min(runs.size(), static_cast<std::size_t>(options.array_size));
  std::vector<std::string> lists(tasks);
  for (std::size_t i = 0; i < runs.size(); ++i) lists[i % tasks] += id_of(folder.plan(), runs[i]) + "\n";
  for (std::size_t task = 0; task < tasks; ++task) {
    const fs::path list = jobs.folder / ("task-" + std::to_string(task) + ".txt");
    if (auto done = results::write_file(list, lists[task]); !done) return done.error();
  }
  const std::string lukou = shell_word(fs::read_symlink("/proc/self/exe").string());
  const std::string study = shell_word(folder.path().string());
  const std::string task_script = "#!/bin/sh\nexec " + lukou + " sweep " + study + " --task " +
                                  shell_word((jobs.folder / "task-").string()) + "\"$SLURM_ARRAY_TASK_ID\".txt\n";
  const std::string gathering_script =
      "#!/bin/sh\n" + lukou + " report " + study + "; touch " + shell_word((jobs.folder / kGathered).string()) + "\n";
  if (auto done = results::write_file(jobs.folder / "task.sh", task_script); !done) return done.error();
  if (auto done = results::write_file(jobs.folder / "gather.sh", gathering_script); !done) return done.error();

  const std::string name = "--job-name=lukou-" + folder.study().name;
  std::vector<std::string> more = {name, "--array=0-" + std::to_string(tasks - 1),
                                   "--output=" + (jobs.folder / "task-%a.log").string()};
  more.insert(more.end(), options.options.begin(), options.options.end());
  auto array = submit_script(jobs.folder / "task.sh", more);
  if (!array) return array.error();
  jobs.array = std::move(array).value();
  more = {name, "--dependency=afterany:" + jobs.array, "--output=" + (jobs.folder / "gather.log").string()};
  more.insert(more.end(), options.options.begin(), options.options.end());
  auto gathering = submit_script(jobs.folder / "gather.sh", more);
  if (!gathering) return gathering.error();
  jobs.gathering = std::move(gathering).value();
  const std::string ids = jobs.array + "," + jobs.gathering + "\n";
  if (auto done = results::write_file(base / kJobsFile, ids); !done) return done.error();
  return jobs;
}

Expected<int> follow(const StudyFolder& folder, const SlurmJobs& jobs, const std::vector<RunKey>& runs,
                     const SweepListener& listener) {
  const double begun_s = process::wall_s();
  double asked_s = begun_s;
  SweepNews news{.total = runs.size()};
  std::map<RunKey, int> over;  ///< exit codes of runs that have a marker
  while (true) {
    for (const RunKey& run : runs) {
      if (over.contains(run)) continue;
      if (const auto marker = folder.marker(run)) over.emplace(run, marker->exit_code);
    }
    news.done = over.size();
    news.failed = news.anomalies = 0;
    for (const auto& [run, code] : over) {
      news.anomalies += code == process::kExitAnomaly ? 1U : 0U;
      news.failed += code != process::kExitAnomaly && code != process::kExitDone ? 1U : 0U;
    }
    const double now_s = process::wall_s();
    news.wall_s = now_s - begun_s;
    if (news.done > 0) {
      news.left_s = news.wall_s / static_cast<double>(news.done) * static_cast<double>(news.total - news.done);
    }
    if (listener) listener(news);
    std::error_code code;
    if (fs::exists(jobs.folder / kGathered, code)) return 0;
    if (const int signal = process::stop_signal(); signal != 0) return signal;
    if (now_s - asked_s > kAskEvery_s) {
      asked_s = now_s;
      // Somebody may have cancelled the jobs.
      const auto at_work = are_at_work(jobs.array + "," + jobs.gathering);
      if (!at_work) return at_work.error();
      if (!at_work.value()) return 0;
    }
    process::sleep_s(kLookEvery_s);
  }
}

Expected<std::vector<RunKey>> runs_of_task(const StudyFolder& folder, const fs::path& list) {
  const auto content = scenario::read_file(list);
  if (!content) return Error{list.string(), content.error().what};
  std::vector<RunKey> runs;
  std::istringstream lines(content.value());
  for (std::string line; std::getline(lines, line);) {
    // "p017-s3"
    const std::size_t dash = line.find("-s");
    const auto point = std::ranges::find(folder.plan().points, line.substr(0, dash), &Point::id);
    if (dash == std::string::npos || point == folder.plan().points.end()) {
      return Error{list.string(), "`" + line + "` is no run of this study"};
    }
    const RunKey run{static_cast<std::size_t>(point - folder.plan().points.begin()),
                     std::stoull(line.substr(dash + 2))};
    const auto marker = folder.marker(run);
    if (!marker || marker->failed()) runs.push_back(run);
  }
  return runs;
}

}  // namespace lukou::studies
