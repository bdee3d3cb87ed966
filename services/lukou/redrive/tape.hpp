#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/directive.hpp"
#include "common/core/expected.hpp"
#include "common/run_log/run_log_reader.hpp"
#include "services/lukou/redrive/answer.hpp"

namespace lukou::redrive {

/// What RSUs got in a step, and what those of the record answered.
struct TapeStep {
  Step step = -1;
  std::vector<Directive> directives;
  std::optional<SignalBatch> signal;  ///< that came in force with this step
  AirBatch air;
  std::map<std::uint64_t, std::uint32_t> cars;  ///< vehicle by the temporary id with which it spoke
  std::vector<std::optional<Answer>> answers;   ///< by RSU; empty: the engine did not hear the first start of it
};

/// A run log as the roadside knew the run.
class Tape {
 public:
  /// Errors: no log, or one that does not hold what was said.
  static Expected<Tape> open(const std::filesystem::path& folder);

  [[nodiscard]] const run_log::Facts& facts() const { return log_.facts(); }
  /// The last step whose answers are recorded: the one before the last of the log. Below 0: none is.
  [[nodiscard]] Step last() const { return log_.last_step() - 1; }
  /// The operator's changes, all of the run.
  [[nodiscard]] Expected<std::vector<Directive>> directives() const { return log_.directives(); }
  /// The next step, from 0 on; null behind the last. Errors: a broken log.
  Expected<TapeStep*> next();

 private:
  explicit Tape(run_log::RunLogReader log) : log_(std::move(log)) {}
  Expected<bool> read();

  run_log::RunLogReader log_;
  run_log::LoggedStep logged_;  ///< of the step behind `step_`, whose answers it holds
  TapeStep step_;
};

}  // namespace lukou::redrive
