#include <poll.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <memory>

#include "common/process/environment.hpp"
#include "services/lukou/launch/child.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

constexpr int kLook_ms = 50;
constexpr double kKill_s = 1.5;  ///< after SIGTERM, until SIGKILL

/// Whether whoever holds the other end of standard input has let go.
bool let_go() {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (poll(&input, 1, kLook_ms) <= 0) return false;
  std::array<char, 256> ignored{};
  return read(STDIN_FILENO, ignored.data(), ignored.size()) <= 0;
}

/// Runs a program for a launcher on another host: it dies with the connection, and how it ended is told by the exit
/// code, 128 + n for signal n.
int leash(const std::vector<std::string>& command) {
  process::catch_stop_signals();
  std::signal(SIGHUP, SIG_IGN);  // the connection's end is seen at standard input
  std::signal(SIGPIPE, SIG_IGN);
  launch::Children children;
  if (auto done = children.start({.role = command.front(), .command = command}); !done) {
    std::fprintf(stderr, "%s\n", done.error().text().c_str());
    return process::kExitInternal;
  }
  double terminated_s = 0.0;
  while (true) {
    if (terminated_s == 0.0 && (let_go() || process::stop_signal() != 0)) {
      children.signal_all(SIGTERM);
      terminated_s = process::wall_s();
    } else if (terminated_s != 0.0) {
      process::sleep_s(kLook_ms * 1e-3);
      if (process::wall_s() - terminated_s > kKill_s) children.signal_all(SIGKILL);
    }
    for (const launch::ChildExit& ended : children.reap()) return ended.signalled ? 128 + ended.code : ended.code;
  }
}

}  // namespace

Action add_leash(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("leash", "run a program until standard input ends")->group("");
  auto command = std::make_shared<std::vector<std::string>>();
  verb->add_option("command", *command, "program and arguments")->required();
  return [command] { return leash(*command); };
}

}  // namespace lukou
