#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lukou::test {

/// A folder of its own under the temporary folder, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// A `lukou` process with its standard streams in files.
class Program {
 public:
  /// Starts `lukou` with these arguments; `environment`: "NAME=value" to add.
  explicit Program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {},
                   const std::string& program = LUKOU_PROGRAM);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits for its end; a process that outlives the limit is killed and -1 returned. Death by signal n: 128 + n.
  int wait(double limit_s = 120.0);
  [[nodiscard]] bool running();
  void signal(int signal) const;
  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;

 private:
  TemporaryFolder streams_;
  pid_t pid_ = -1;
  int code_ = -1;
  bool ended_ = false;
};

/// Runs `lukou` to its end.
struct Finished {
  int code = -1;
  std::string out;
  std::string err;
};
Finished lukou(const std::vector<std::string>& arguments);

struct RunningProcess {
  pid_t pid = -1;
  std::vector<std::string> command;  ///< program and arguments
};
/// Processes with this variable ("NAME=value") in their environment: whom a process started with it, and so on.
std::vector<RunningProcess> processes_with(const std::string& variable);
/// Pids of the processes that belong to the run, by program name ("lukou-clock"); the launcher is not among them.
std::map<std::string, pid_t> processes_of(const std::string& run);
/// Waits until the recorder has recorded step `step`; false if that takes more than 30 s.
[[nodiscard]] bool wait_for_step(const std::string& run, long long step);
/// Seconds until no process of the run is left; more than `limit_s` if some is.
double seconds_until_gone(const std::string& run, double limit_s);
/// A name for a run that no other test uses.
std::string fresh_run_id();

std::string content(const std::filesystem::path& file);
/// Names of result files whose bytes differ between the folders, or that one of them lacks; facts of the wall clock and
/// the manifest's culprit excepted.
std::vector<std::string> differing_files(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lukou::test
