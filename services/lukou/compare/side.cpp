#include "services/lukou/compare/side.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "scenario.pb.h"
#include "services/lukou/report/result.hpp"
#include "services/lukou/study/measure.hpp"

namespace lukou::compare {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using studies::RunRecord;

/// The value of a measure that summaries always have.
double count_in(const Json& summary, const char* path) { return studies::value_of(summary, path).value_or(0.0); }

Expected<RunRecord> run_of(const fs::path& folder) {
  const auto result = report::Result::open(folder);
  if (!result) return result.error();
  const auto summary = result.value().need_summary();
  if (!summary) return summary.error();
  RunRecord run;
  run.key.seed = result.value().scenario().message().run().seed();
  run.state = RunRecord::State::kDone;
  if (result.value().manifest()) {
    run.manifest = *result.value().manifest();
    if (run.manifest.ended_by.starts_with("anomaly")) run.state = RunRecord::State::kAnomaly;
  }
  run.simulated_s = count_in(*summary.value(), "simulated_s");
  run.warmup_s = count_in(*summary.value(), "warmup_s");
  run.arrived = count_in(*summary.value(), "vehicles_arrived");
  run.left = count_in(*summary.value(), "vehicles_left");
  return run;
}

bool is_result(const fs::path& folder) {
  std::error_code code;
  return fs::is_regular_file(folder / "scenario.textproto", code);
}

/// A run, or the runs in a folder, one a seed.
Expected<Side> side_of_results(const std::string& name) {
  std::vector<fs::path> folders;
  if (is_result(name)) {
    folders.emplace_back(name);
  } else {
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(name, code))
      if (is_result(entry.path())) folders.push_back(entry.path());
    std::ranges::sort(folders);
  }
  if (folders.empty()) {
    return Error{name, "is no result folder, no folder of result folders and no study; an arm of a study is STUDY:ARM"};
  }
  Side side{.name = name, .measures = studies::default_measures(), .groups = {Group{}}};
  std::set<std::uint64_t> seeds;
  for (const fs::path& folder : folders) {
    auto run = run_of(folder);
    if (!run) return run.error();
    if (!seeds.insert(run.value().key.seed).second) {
      return Error{folder.string(), "has seed " + std::to_string(run.value().key.seed) +
                                        " as another result in the folder; one a seed would be right"};
    }
    side.groups.front().runs.push_back(std::move(run).value());
    side.groups.front().folders.push_back(folder);
  }
  return side;
}

std::string arms_text(const std::string& folder, const studies::Study& study) {
  std::string text;
  for (const studies::Arm& arm : study.arms) text += (text.empty() ? "" : ", ") + folder + ":" + arm.name;
  return text;
}

Expected<Side> side_of_study(const std::string& name, const std::string& folder, const std::string& arm) {
  const auto opened = studies::StudyFolder::open(folder);
  if (!opened) return opened.error();
  const studies::Study& study = opened.value().study();
  std::size_t number = 0;
  if (!arm.empty() || study.arms.size() > 1) {
    const auto found = std::ranges::find(study.arms, arm, &studies::Arm::name);
    if (found == study.arms.end()) {
      return Error{name, (arm.empty() ? "is a study of several arms" : "is no arm of the study") +
                             std::string("; there are ") + arms_text(folder, study)};
    }
    number = static_cast<std::size_t>(found - study.arms.begin());
  }
  const auto gathered = studies::gather(opened.value());
  if (!gathered) return gathered.error();
  Side side{.name = name, .measures = study.measures, .groups = {}};
  for (const studies::Cell& cell : opened.value().plan().cells) {
    Group group{.label = text(study, cell), .runs = {}, .folders = {}};
    const std::string& grid = study.grids[cell.grid].name;
    if (study.grids.size() > 1 && !grid.empty()) group.label = grid + ": " + group.label;
    for (const RunRecord& run : gathered.value().points[cell.points[number]]) {
      if (!run.has_result()) {
        ++side.failed;
        continue;
      }
      group.runs.push_back(run);
      group.folders.push_back(opened.value().result(run.key));
    }
    if (!group.runs.empty()) side.groups.push_back(std::move(group));
  }
  if (side.groups.empty()) return Error{name, "has no run with a result yet; `lukou sweep --resume` makes them"};
  return side;
}

}  // namespace

Expected<Side> open_side(const std::string& name) {
  std::error_code code;
  if (studies::StudyFolder::is_one(name)) return side_of_study(name, name, "");
  if (fs::exists(name, code)) return side_of_results(name);
  for (std::size_t colon = name.find(':'); colon != std::string::npos; colon = name.find(':', colon + 1)) {
    const std::string folder = name.substr(0, colon);
    if (studies::StudyFolder::is_one(folder)) return side_of_study(name, folder, name.substr(colon + 1));
  }
  return Error{name, "is no folder; a result folder, a folder of these, or STUDY:ARM would be right"};
}

Expected<Done> read_values(Side& side, const std::vector<std::string>& measures) {
  for (Group& group : side.groups)
    for (std::size_t i = 0; i < group.runs.size(); ++i) {
      const auto summary = studies::read_summary(group.folders[i]);
      if (!summary) return summary.error();
      group.runs[i].values = studies::values_of(group.runs[i], summary.value(), measures);
    }
  return Done{};
}

}  // namespace lukou::compare
