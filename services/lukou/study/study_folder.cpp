#include "services/lukou/study/study_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/results/json.hpp"
#include "common/results/manifest.hpp"
#include "common/results/result_folder.hpp"
#include "services/lukou/study/series.hpp"

namespace lukou::studies {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kDone = "done.json";
constexpr const char* kFailed = "failed.json";
constexpr Step kObservationsPerCycle = 5;

}  // namespace

StudyFolder::StudyFolder(fs::path path, Study study)
    : path_(std::move(path)), study_(std::move(study)), plan_(plan_of(study_)) {}

bool StudyFolder::is_one(const fs::path& folder) {
  std::error_code code;
  return fs::is_regular_file(folder / kStudyFile, code);
}

Expected<StudyFolder> StudyFolder::create(const fs::path& folder, Study study) {
  const auto made = results::ResultFolder::create(folder);
  if (!made) return made.error();
  // The study's text comes last: a folder that has it is whole.
  if (auto done = made.value().write_file(kBaseFile, study.base_text); !done) return done.error();
  if (auto done = made.value().write_file(kStudyFile, study.text); !done) return done.error();
  return StudyFolder(fs::absolute(folder), std::move(study));
}

Expected<StudyFolder> StudyFolder::open(const fs::path& folder) {
  if (!is_one(folder)) return Error{folder.string(), "is no study's folder: it holds no study.textproto"};
  auto study = load((folder / kStudyFile).string());
  if (!study) return study.error();
  return StudyFolder(fs::absolute(folder), std::move(study).value());
}

Expected<Done> StudyFolder::extend(const Study& study) {
  if (study.core != study_.core) {
    return Error{path_.string(),
                 "was made by another study or with other settings; give the same ones, the folder itself in place of "
                 "the study, or another --out"};
  }
  if (study.text == study_.text) return Done{};
  study_ = study;
  return results::write_file(path_ / kStudyFile, study_.text);
}

Expected<Done> StudyFolder::lock() const {
  const int file = ::open((path_ / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return Error{path_.string(), std::string("cannot be written: ") + std::strerror(errno)};
  // Held until the process ends, however it ends.
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return Done{};
  return Error{path_.string(), "another sweep is at work in it"};
}

fs::path StudyFolder::run(const RunKey& key) const { return path_ / "runs" / id_of(plan_, key); }

Expected<fs::path> StudyFolder::prepare(const RunKey& key) const {
  const fs::path folder = run(key);
  std::error_code code;
  fs::remove_all(folder, code);
  if (!code) fs::create_directories(folder, code);
  if (code) return Error{folder.string(), "cannot be made: " + code.message()};
  const auto scenario = scenario_of(study_, plan_.points[key.point], key.seed);
  if (!scenario) return scenario.error();
  const fs::path file = folder / "scenario.textproto";
  if (auto done = results::write_file(file, scenario::text(scenario.value())); !done) return done.error();
  return file;
}

Expected<Done> StudyFolder::reduce(const RunKey& key) const {
  const auto scenario = scenario_of(study_, plan_.points[key.point], key.seed);
  if (!scenario) return scenario.error();
  const auto plan = scenario::signal_plan(scenario.value());
  if (!plan) return plan.error();
  const auto series = series_of(result(key), std::max<Step>(1, plan.value().cycle / kObservationsPerCycle));
  if (!series) return series.error();
  if (auto done = results::write_file(run(key) / kSeriesFile, text(series.value())); !done) return done;
  std::error_code code;
  fs::remove(run(key) / "scenario.textproto", code);  // it stands in the result
  if (std::ranges::find(study_.keep, "*") != study_.keep.end()) return Done{};
  const std::vector<std::string> always = {"summary.json", results::kManifest, "scenario.textproto"};
  for (const auto& entry : fs::directory_iterator(result(key), code)) {
    const std::string name = entry.path().filename();
    const auto in = [&](const std::vector<std::string>& names) {
      return std::ranges::find(names, name) != names.end();
    };
    if (!in(always) && !in(study_.keep)) fs::remove(entry.path(), code);
  }
  return Done{};
}

Expected<Done> StudyFolder::mark(const RunKey& key, const RunMarker& marker) const {
  Json json = {
      {"exit_code", marker.exit_code}, {"attempts", marker.attempts}, {"wall_s", marker.wall_s}, {"host", marker.host}};
  if (marker.failed()) json["what"] = marker.what;
  return results::write_file(run(key) / (marker.failed() ? kFailed : kDone), results::json_text(json));
}

std::optional<RunMarker> StudyFolder::marker(const RunKey& key) const {
  for (const char* name : {kDone, kFailed}) {
    const auto content = scenario::read_file(run(key) / name);
    if (!content) continue;
    const Json json = Json::parse(content.value(), nullptr, false);
    if (!json.is_object() || !json.contains("exit_code")) continue;
    return RunMarker{.exit_code = json.value("exit_code", 1),
                     .attempts = json.value("attempts", 1),
                     .wall_s = json.value("wall_s", 0.0),
                     .host = json.value("host", ""),
                     .what = json.value("what", "")};
  }
  return std::nullopt;
}

}  // namespace lukou::studies
