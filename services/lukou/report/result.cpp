#include "services/lukou/report/result.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

namespace lukou::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScenario = "scenario.textproto";
constexpr const char* kDirectives = "directives.textproto";
constexpr const char* kSummary = "summary.json";

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool is_file(const fs::path& file) {
  std::error_code code;
  return fs::is_regular_file(file, code);
}

}  // namespace

Result::Result(fs::path folder, scenario::Resolved scenario)
    : folder_(std::move(folder)),
      scenario_(std::move(scenario)),
      summary_(std::make_unique<nlohmann::ordered_json>(nullptr)) {}

Result::Result(Result&& other) noexcept = default;
Result& Result::operator=(Result&& other) noexcept = default;
Result::~Result() = default;

Expected<Result> Result::open(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code)) return Error{folder.string(), "is no result folder"};
  if (!is_file(folder / kScenario)) {
    return Error{folder.string(), "is no result folder: it holds no " + std::string(kScenario)};
  }
  auto scenario = scenario::load((folder / kScenario).string());
  if (!scenario) return scenario.error();
  Result result(folder, std::move(scenario).value());
  if (is_file(folder / results::kManifest)) {
    const fs::path file = folder / results::kManifest;
    auto manifest = results::parse_manifest(content_of(file), file.string());
    if (!manifest) return manifest.error();
    result.manifest_ = std::move(manifest).value();
  }
  if (is_file(folder / kSummary)) {
    *result.summary_ = nlohmann::ordered_json::parse(content_of(folder / kSummary), nullptr, false);
    if (!result.summary_->is_object()) return Error{(folder / kSummary).string(), "is no JSON object"};
  }
  if (is_file(folder / kDirectives)) {
    auto directives = scenario::load_directives(folder / kDirectives);
    if (!directives) return directives.error();
    result.directives_ = std::move(directives).value();
  }
  return result;
}

std::string Result::name() const {
  const fs::path whole = fs::absolute(folder_).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

bool Result::holds(std::string_view file) const { return is_file(folder_ / file); }

Expected<const nlohmann::ordered_json*> Result::need_summary() const {
  if (!summary_->is_object()) {
    return Error{folder_.string(), "holds no summary.json: the run has not ended, or ended without its recorder"};
  }
  return static_cast<const nlohmann::ordered_json*>(summary_.get());
}

Expected<run_log::RunLogReader> Result::run_log(run_log::Level least, std::string_view who) const {
  const std::string level(run_log::name(least));
  if (!holds(run_log::kRunLog)) {
    return Error{folder_.string(), "holds no run.mcap; " + std::string(who) +
                                       " needs it: record it with `lukou run SCENARIO --set record.log=" + level + "`"};
  }
  auto log = run_log::RunLogReader::open(folder_);
  if (!log) return log.error();
  if (log.value().facts().level < least) {
    return Error{(folder_ / run_log::kRunLog).string(),
                 "was recorded with record.log=" + std::string(run_log::name(log.value().facts().level)) + "; " +
                     std::string(who) + " needs " + level};
  }
  return log;
}

Expected<fs::path> Result::table(std::string_view name, std::string_view how_to_record) const {
  if (holds(name)) return folder_ / name;
  return Error{folder_.string(), "holds no " + std::string(name) + "; record it with `lukou run SCENARIO " +
                                     std::string(how_to_record) + "`"};
}

}  // namespace lukou::report
