#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"

namespace lukou::launch {

struct ChildSpec {
  std::string role;
  std::vector<std::string> command;      ///< program and arguments
  std::vector<std::string> environment;  ///< "NAME=value", added to ours
  std::optional<int> core;               ///< pinned to this processor
  std::filesystem::path log;             ///< standard output and error go to its end; empty = ours
};

/// How a child ended.
struct ChildExit {
  std::string role;
  bool signalled = false;
  int code = 0;  ///< exit code or signal number

  [[nodiscard]] bool well() const { return !signalled && code == 0; }
  [[nodiscard]] std::string text() const;  ///< "was killed by signal 9 (Killed)", "exited with code 1"
};

/// The processes of a run. They end with this process, whatever happens to it; Ctrl-C does not reach them.
class Children {
 public:
  Children() = default;
  ~Children();
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  Expected<Done> start(const ChildSpec& spec);
  /// Children that have ended since the last call.
  std::vector<ChildExit> reap();
  void signal_all(int signal) const;
  void signal(const std::string& role, int signal) const;
  [[nodiscard]] bool empty() const { return running_.empty(); }
  [[nodiscard]] std::vector<std::pair<std::string, pid_t>> running() const { return running_; }

 private:
  std::vector<std::pair<std::string, pid_t>> running_;
};

}  // namespace lukou::launch
