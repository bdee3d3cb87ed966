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
  bool leashed = false;                  ///< a link to `lukou leash` on another host, which watches its standard input
};

/// How a child ended.
struct ChildExit {
  std::string role;
  bool signalled = false;
  int code = 0;          ///< exit code or signal number
  bool leashed = false;  ///< as its ChildSpec

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

 private:
  struct Running {
    std::string role;
    pid_t pid = -1;
    int leash = -1;  ///< the end of its standard input that we hold; -1: it has none
  };
  std::vector<Running> running_;
};

}  // namespace lukou::launch
