#include "services/lukou/launch/console_process.hpp"

#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "common/process/environment.hpp"

namespace lukou::launch {
namespace {

constexpr int kPortsToTry = 50;
constexpr double kGoodbye_s = 1.5;  ///< for its last words to the viewers
constexpr std::string_view kRole = "console";

}  // namespace

Expected<ConsoleProcess> ConsoleProcess::start(std::uint16_t port, std::vector<std::string> environment) {
  auto ends = process::LineLink::pair();
  if (!ends) return ends.error();
  const int theirs = ends.value().second;
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "lukou-console";
  auto child = std::make_unique<Children>();
  auto started = child->start({.role = std::string(kRole),
                               .command = {program.string(), "--launcher", std::to_string(theirs), "--port",
                                           std::to_string(port), "--ports", std::to_string(kPortsToTry)},
                               .environment = std::move(environment)});
  ::close(theirs);
  if (!started) return started.error();
  return ConsoleProcess(std::move(ends.value().first), std::move(child));
}

void ConsoleProcess::show(const bus::Address& run) { link_.say("run " + run.run + " " + std::to_string(run.domain)); }

void ConsoleProcess::poll() {
  child_->reap();
  for (const std::string& line : link_.take()) {
    const std::size_t space = line.find(' ');
    const std::string what = line.substr(0, space);
    const std::string rest = space == std::string::npos ? "" : line.substr(space + 1);
    if (what == "listening") std::fprintf(stderr, "console: %s\n", rest.c_str());
    if (what == "viewers") std::from_chars(rest.data(), rest.data() + rest.size(), viewers_);
    if (what == "restart") {
      std::uint64_t seed = 0;
      const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), seed);
      if (parsed.ec == std::errc()) restart_ = seed;
    }
  }
}

std::optional<std::uint64_t> ConsoleProcess::take_restart() { return std::exchange(restart_, std::nullopt); }

void ConsoleProcess::end() {
  child_->signal_all(SIGTERM);
  const double begin_s = process::wall_s();
  while (!child_->empty() && process::wall_s() - begin_s < kGoodbye_s) {
    process::sleep_s(0.02);
    child_->reap();
  }
}

}  // namespace lukou::launch
