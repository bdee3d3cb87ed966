#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "services/lukou/study/plan.hpp"

namespace lukou::studies {

/// How a run of a study ended, as far as the study cares. Facts of the wall clock are for people and logs alone.
struct RunMarker {
  int exit_code = 0;  ///< of `lukou run`; a signal n that killed it is 128 + n
  int attempts = 1;
  double wall_s = 0.0;
  std::string host;
  std::string what;  ///< why it failed; empty if it did not

  /// An anomaly (exit code 4) is a result of the simulation.
  [[nodiscard]] bool failed() const { return exit_code != 0 && exit_code != 4; }
};

/// The folder of a study: study.textproto, base.textproto, and for each run runs/<id>/ with its result folder, log and
/// marker. A run counts once its marker is there, which is written whole or not at all, after everything else.
class StudyFolder {
 public:
  /// A new folder: it must not exist, or be empty. Folders above it are made.
  static Expected<StudyFolder> create(const std::filesystem::path& folder, Study study);
  /// The folder of a study that was begun before.
  static Expected<StudyFolder> open(const std::filesystem::path& folder);
  /// Whether there is one.
  static bool is_one(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const Study& study() const { return study_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }

  /// Takes another study's number of seeds. Error: it differs in more than that.
  Expected<Done> extend(const Study& study);
  /// Keeps other sweeps out of this folder until this process ends. Error: another is in it.
  [[nodiscard]] Expected<Done> lock() const;

  [[nodiscard]] std::filesystem::path run(const RunKey& key) const;
  [[nodiscard]] std::filesystem::path result(const RunKey& key) const { return run(key) / "result"; }
  [[nodiscard]] std::filesystem::path log(const RunKey& key) const { return run(key) / "log.txt"; }
  /// Makes the run's folder anew, with the scenario that it is to run.
  [[nodiscard]] Expected<std::filesystem::path> prepare(const RunKey& key) const;
  /// Drops the tables that the study does not keep; takes the series before. For a run that did not fail.
  [[nodiscard]] Expected<Done> reduce(const RunKey& key) const;
  [[nodiscard]] Expected<Done> mark(const RunKey& key, const RunMarker& marker) const;
  [[nodiscard]] std::optional<RunMarker> marker(const RunKey& key) const;

 private:
  StudyFolder(std::filesystem::path path, Study study);

  std::filesystem::path path_;
  Study study_;
  Plan plan_;
};

}  // namespace lukou::studies
