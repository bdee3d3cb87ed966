#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/directive.hpp"
#include "common/core/expected.hpp"
#include "common/run_log/run_log_reader.hpp"
#include "services/recorder/run_picture.hpp"

namespace lukou::replay {

/// A run log as a film: what observers saw of the run, at any step. Going back is quick, since pictures of places once
/// passed are kept.
class Recording {
 public:
  /// Errors: no log, or one that does not hold every car in every step.
  static Expected<Recording> open(const std::filesystem::path& folder);

  [[nodiscard]] Step last() const { return log_.last_step(); }
  [[nodiscard]] const std::string& scenario() const { return log_.facts().scenario; }
  /// The operator's changes, all of the run.
  [[nodiscard]] const std::vector<Directive>& directives() const { return directives_; }

  /// Goes towards a step, by at most `most` steps; returns the step that it stands at then. Errors: a broken log.
  Expected<Step> go_towards(Step step, Step most);
  /// What observers saw at the step that it stands at. Requires one: go_towards() has been called.
  void fill(View& view) const { picture_.fill(view); }

 private:
  Recording(run_log::RunLogReader log, const MeasureParameters& parameters, std::vector<Directive> directives);

  run_log::RunLogReader log_;
  std::vector<Directive> directives_;
  RunPicture picture_;
  Step at_ = -1;
  std::map<Step, RunPicture> kept_;  ///< by the step that each stands at; -1: before the first
};

}  // namespace lukou::replay
