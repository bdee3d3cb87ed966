#include "services/lukou/replay/again.hpp"

#include <stdlib.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "common/process/environment.hpp"
#include "common/results/inspection.hpp"
#include "common/run_log/run_log.hpp"
#include "common/scenario/scenario.hpp"
#include "services/lukou/launch/run_request.hpp"
#include "services/lukou/report/progress.hpp"

namespace lukou::replay {
namespace {

namespace fs = std::filesystem;

/// The name of a table that both folders hold and that differs; empty: none does.
Expected<std::string> difference(const fs::path& before, const fs::path& again) {
  const auto old_files = results::result_files(before);
  if (!old_files) return old_files.error();
  const auto new_files = results::result_files(again);
  if (!new_files) return new_files.error();
  for (const results::FileEntry& file : old_files.value()) {
    const auto found = std::ranges::find(new_files.value(), file.name, &results::FileEntry::name);
    if (!file.name.ends_with(".csv") || found == new_files.value().end()) continue;
    if (found->sha256 != file.sha256) return file.name;
  }
  return std::string();
}

}  // namespace

Expected<ComputedAgain> ComputedAgain::compute(const fs::path& result) {
  auto scenario = scenario::load((result / "scenario.textproto").string(), {"record.log=FULL"});
  if (!scenario) return scenario.error();
  std::string pattern = (fs::temp_directory_path() / "lukou-replay-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) return Error{pattern, "cannot be made"};
  ComputedAgain computed{pattern};
  launch::RunRequest request{.scenario = std::move(scenario).value(), .name = "again", .in_process = true};
  request.out = computed.folder();
  const fs::path directives = result / "directives.textproto";
  std::error_code code;
  if (fs::file_size(directives, code) > 0 && !code) request.replay = directives;
  report::Progress progress;
  const launch::RunReport report =
      launch::run_in_process(request, [&progress](const launch::RunNews& news) { progress.show(news); });
  progress.finish();
  if (report.exit_code != process::kExitDone && report.exit_code != process::kExitAnomaly) {
    return Error{result.string(), "cannot be computed again: " + report.ended};
  }
  const auto differs = difference(result, computed.folder());
  if (!differs) return differs.error();
  if (!differs.value().empty()) {
    return Error{(result / differs.value()).string(),
                 "differs when the run is computed again: it was driven by an RSU program that is not shipped, or "
                 "recorded by another version"};
  }
  return computed;
}

ComputedAgain::ComputedAgain(ComputedAgain&& other) noexcept : temporary_(std::exchange(other.temporary_, {})) {}

ComputedAgain& ComputedAgain::operator=(ComputedAgain&& other) noexcept {
  std::swap(temporary_, other.temporary_);
  return *this;
}

ComputedAgain::~ComputedAgain() {
  std::error_code code;
  if (!temporary_.empty()) fs::remove_all(temporary_, code);
}

}  // namespace lukou::replay
