#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/directive.hpp"
#include "common/core/expected.hpp"
#include "common/run_log/mcap_writer.hpp"
#include "common/run_log/run_log.hpp"

namespace lukou::run_log {

/// Writes run.mcap step by step. Chunks end with steps, never with the wall clock: the bytes depend on the run alone.
class RunLogWriter {
 public:
  /// Requires a level that is not kNone. Errors: the file is there already, or cannot be made.
  static Expected<RunLogWriter> create(const std::filesystem::path& folder, const Facts& facts);
  RunLogWriter(RunLogWriter&& other) noexcept;
  RunLogWriter& operator=(RunLogWriter&& other) noexcept;
  ~RunLogWriter();

  /// The next step: the operator's changes in force from it on, the controller's batch that came in force with it
  /// (null: none did), and the truth. Errors: the disk.
  Expected<Done> add(const std::vector<Directive>& directives, const SignalBatch* signal, const TrafficBatch& traffic);
  /// Writes all and ends the file.
  Expected<Done> close();
  [[nodiscard]] std::string sha256() const { return file_.sha256(); }

 private:
  struct Messages;
  RunLogWriter(McapWriter file, Level level);
  template <class Message>
  void add(const Message& message);

  McapWriter file_;
  Level level_;
  std::unique_ptr<Messages> messages_;  ///< used again, so that a step allocates nothing
  Step step_ = 0;
};

}  // namespace lukou::run_log
