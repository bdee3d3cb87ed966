#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/expected.hpp"
#include "common/results/manifest.hpp"
#include "common/run_log/run_log_reader.hpp"
#include "common/scenario/directive_log.hpp"
#include "common/scenario/scenario.hpp"

namespace lukou::report {

/// A result folder that is looked at. What a run that was killed has not written is missing: manifest and summary.
class Result {
 public:
  /// Errors: no folder, no scenario in it, or a file of it that is broken.
  static Expected<Result> open(const std::filesystem::path& folder);
  Result(Result&& other) noexcept;
  Result& operator=(Result&& other) noexcept;
  ~Result();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// "none7200" of "/some/where/none7200/".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] const scenario::Resolved& scenario() const { return scenario_; }
  [[nodiscard]] const std::optional<results::Manifest>& manifest() const { return manifest_; }
  /// Null if there is none.
  [[nodiscard]] const nlohmann::ordered_json& summary() const { return *summary_; }
  [[nodiscard]] const scenario::DirectiveLog& directives() const { return directives_; }
  [[nodiscard]] bool holds(std::string_view file) const;
  /// summary.json; an error that says why it is missing.
  [[nodiscard]] Expected<const nlohmann::ordered_json*> need_summary() const;

  /// The run log, if it holds at least this much. `who`: what needs it, for the error, which says what to record.
  [[nodiscard]] Expected<run_log::RunLogReader> run_log(run_log::Level least, std::string_view who) const;
  /// A table, if it is there. `how_to_record`: arguments of `lukou run` that make it.
  [[nodiscard]] Expected<std::filesystem::path> table(std::string_view name, std::string_view how_to_record) const;

 private:
  Result(std::filesystem::path folder, scenario::Resolved scenario);

  std::filesystem::path folder_;
  scenario::Resolved scenario_;
  std::optional<results::Manifest> manifest_;
  std::unique_ptr<nlohmann::ordered_json> summary_;
  scenario::DirectiveLog directives_;
};

}  // namespace lukou::report
