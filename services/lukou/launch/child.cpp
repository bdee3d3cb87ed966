#include "services/lukou/launch/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "common/process/environment.hpp"
#include "services/lukou/launch/cores.hpp"

namespace lukou::launch {
namespace {

constexpr int kSignalled = 128;  ///< exit codes beyond: killed by the signal of that number less this one
constexpr int kSshFailed = 255;

/// In the child, between fork and exec. Ends it on failure.
[[noreturn]] void become(const ChildSpec& spec, pid_t parent, int input) {
  prctl(PR_SET_PDEATHSIG, process::launcher_died_signal());
  if (getppid() != parent) _exit(127);  // died meanwhile
  setpgid(0, 0);
  if (spec.core) stay_on(*spec.core);
  if (!spec.log.empty()) {
    const int log = ::open(spec.log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    if (log >= 0) {
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
    }
  }
  if (input < 0) input = ::open("/dev/null", O_RDONLY);
  if (input >= 0) dup2(input, STDIN_FILENO);
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
  if (leashed && code == kSshFailed) return "cannot be reached any more, or never could: ssh failed";
  return "exited with code " + std::to_string(code);
}

Children::~Children() {
  signal_all(SIGKILL);
  for (const Running& child : running_) {
    waitpid(child.pid, nullptr, 0);
    if (child.leash >= 0) ::close(child.leash);
  }
}

Expected<Done> Children::start(const ChildSpec& spec) {
  std::array<int, 2> input = {-1, -1};
  const auto failed = [&] { return Error{spec.role, std::string("cannot be started: ") + std::strerror(errno)}; };
  if (spec.leashed && ::pipe2(input.data(), O_CLOEXEC) != 0) return failed();
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) return failed();
  if (pid == 0) become(spec, parent, input[0]);
  if (input[0] >= 0) ::close(input[0]);
  running_.push_back({spec.role, pid, input[1]});
  return Done{};
}

std::vector<ChildExit> Children::reap() {
  std::vector<ChildExit> ended;
  std::erase_if(running_, [&](const auto& child) {
    int status = 0;
    if (waitpid(child.pid, &status, WNOHANG) != child.pid) return false;
    ChildExit exit{.role = child.role, .leashed = child.leash >= 0};
    exit.signalled = WIFSIGNALED(status);
    exit.code = exit.signalled ? WTERMSIG(status) : WEXITSTATUS(status);
    // A signal at the other end comes as an exit code.
    if (exit.leashed && !exit.signalled && exit.code > kSignalled && exit.code != kSshFailed) {
      exit.signalled = true;
      exit.code -= kSignalled;
    }
    if (child.leash >= 0) ::close(child.leash);
    ended.push_back(exit);
    return true;
  });
  return ended;
}

void Children::signal_all(int signal) const {
  for (const Running& child : running_) kill(child.pid, signal);
}

void Children::signal(const std::string& role, int signal) const {
  for (const Running& child : running_)
    if (child.role == role) kill(child.pid, signal);
}

}  // namespace lukou::launch
