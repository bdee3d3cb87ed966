#include "services/lukou/launch/child.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "common/process/environment.hpp"

namespace lukou::launch {
namespace {

/// In the child, between fork and exec. Ends it on failure.
[[noreturn]] void become(const ChildSpec& spec, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, process::launcher_died_signal());
  if (getppid() != parent) _exit(127);  // died meanwhile
  setpgid(0, 0);
  if (spec.core) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(static_cast<unsigned>(*spec.core), &cores);
    sched_setaffinity(0, sizeof cores, &cores);
  }
  if (!spec.log.empty()) {
    const int log = ::open(spec.log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    if (log >= 0) {
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
    }
  }
  const int null = ::open("/dev/null", O_RDONLY);
  if (null >= 0) dup2(null, STDIN_FILENO);
  for (const std::string& variable : spec.environment) putenv(const_cast<char*>(variable.c_str()));
  std::vector<char*> arguments;
  for (const std::string& word : spec.command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  std::fprintf(stderr, "lukou: cannot start %s: %s\n", arguments[0], std::strerror(errno));
  _exit(127);
}

}  // namespace

std::string ChildExit::text() const {
  if (signalled) return "was killed by signal " + std::to_string(code) + " (" + strsignal(code) + ")";
  return "exited with code " + std::to_string(code);
}

Children::~Children() {
  signal_all(SIGKILL);
  for (const auto& [role, pid] : running_) waitpid(pid, nullptr, 0);
}

Expected<Done> Children::start(const ChildSpec& spec) {
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) return Error{spec.role, std::string("cannot be started: ") + std::strerror(errno)};
  if (pid == 0) become(spec, parent);
  running_.emplace_back(spec.role, pid);
  return Done{};
}

std::vector<ChildExit> Children::reap() {
  std::vector<ChildExit> ended;
  std::erase_if(running_, [&](const auto& child) {
    int status = 0;
    if (waitpid(child.second, &status, WNOHANG) != child.second) return false;
    if (WIFSIGNALED(status)) {
      ended.push_back({child.first, true, WTERMSIG(status)});
    } else {
      ended.push_back({child.first, false, WEXITSTATUS(status)});
    }
    return true;
  });
  return ended;
}

void Children::signal_all(int signal) const {
  for (const auto& [role, pid] : running_) kill(pid, signal);
}

void Children::signal(const std::string& role, int signal) const {
  for (const auto& [of_role, pid] : running_)
    if (of_role == role) kill(pid, signal);
}

}  // namespace lukou::launch
