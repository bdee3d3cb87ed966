#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/participant.hpp"
#include "common/process/line_link.hpp"
#include "services/lukou/launch/child.hpp"

namespace lukou::launch {

/// The console that `lukou run --console` starts: no part of the run, it may die at any time; outlives the run as long
/// as somebody looks at it.
class ConsoleProcess {
 public:
  /// Listens at the first free port from `port` on. `environment`: how it reaches runs. Errors: the program cannot be
  /// started.
  static Expected<ConsoleProcess> start(std::uint16_t port, std::vector<std::string> environment);

  /// Shows this run from now on.
  void show(const bus::Address& run);
  /// Takes what the console says. Prints its address once it listens.
  void poll();
  /// The seed with which a viewer wants the run started anew, once.
  [[nodiscard]] std::optional<std::uint64_t> take_restart();
  [[nodiscard]] std::size_t viewers() const { return viewers_; }
  [[nodiscard]] bool alive() const { return link_.open(); }
  void end();

 private:
  ConsoleProcess(process::LineLink link, std::unique_ptr<Children> child)
      : link_(std::move(link)), child_(std::move(child)) {}

  process::LineLink link_;
  std::unique_ptr<Children> child_;
  std::size_t viewers_ = 0;
  std::optional<std::uint64_t> restart_;
};

}  // namespace lukou::launch
