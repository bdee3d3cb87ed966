#include "common/results/manifest.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "common/results/json.hpp"

namespace lukou::results {
namespace {

using Json = nlohmann::ordered_json;

/// Reads fields of an object and keeps the first thing that is wrong.
class Reader {
 public:
  Reader(const Json& object, std::string owner) : object_(object), owner_(std::move(owner)) {}

  std::string text(const char* key) {
    const Json* value = find(key);
    if (value != nullptr && !value->is_string()) fail(key, "must be a text");
    return value != nullptr && value->is_string() ? value->get<std::string>() : "";
  }
  template <class Number>
  Number whole(const char* key) {
    const Json* value = find(key);
    const bool fits = value != nullptr && value->is_number_unsigned();
    if (value != nullptr && !fits) fail(key, "must be a whole number of at least 0");
    return fits ? value->get<Number>() : Number{};
  }
  [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  const Json* find(const char* key) {
    const auto found = object_.find(key);
    if (found != object_.end()) return &*found;
    fail(key, "is missing");
    return nullptr;
  }
  void fail(const char* key, const char* what) {
    if (error_.empty()) error_ = owner_ + key + " " + what;
  }

  const Json& object_;
  std::string owner_;
  std::string error_;
};

}  // namespace

bool is_ended_by(std::string_view text) {
  static constexpr std::array<std::string_view, 4> kAlone = {"done", "stopped", "interrupted", "disk"};
  static constexpr std::array<std::string_view, 3> kWithName = {"anomaly:", "lost:", "stalled:"};
  for (const std::string_view word : kAlone)
    if (text == word) return true;
  for (const std::string_view word : kWithName)
    if (text.starts_with(word) && text.size() > word.size()) return true;
  return false;
}

std::string text(const Manifest& manifest) {
  Json files = Json::array();
  for (const FileEntry& file : manifest.files) {
    Json entry = {{"name", file.name}, {"sha256", file.sha256}};
    if (file.rows) entry["rows"] = *file.rows;
    files.push_back(std::move(entry));
  }
  const Json json = {{"lukou_version", manifest.lukou_version},
                     {"scenario_hash", manifest.scenario_hash},
                     {"seed", manifest.seed},
                     {"steps_planned", manifest.steps_planned},
                     {"complete_to_step", manifest.complete_to_step},
                     {"ended_by", manifest.ended_by},
                     {"culprit", manifest.culprit},
                     {"files", files}};
  return json_text(json);
}

Expected<Manifest> parse_manifest(const std::string& text, const std::string& origin) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return Error{origin, "is not JSON"};
  if (!json.is_object()) return Error{origin, "must be a JSON object"};
  Reader read(json, "");
  Manifest manifest;
  manifest.lukou_version = read.text("lukou_version");
  manifest.scenario_hash = read.text("scenario_hash");
  manifest.seed = read.whole<std::uint64_t>("seed");
  manifest.steps_planned = read.whole<Step>("steps_planned");
  manifest.complete_to_step = read.whole<Step>("complete_to_step");
  manifest.ended_by = read.text("ended_by");
  manifest.culprit = read.text("culprit");
  if (!read.error().empty()) return Error{origin, read.error()};
  if (!is_ended_by(manifest.ended_by)) {
    return Error{origin, "ended_by is `" + manifest.ended_by +
                             "`, must be done, stopped, interrupted, anomaly:<what>, lost:<role>, stalled:<role> or "
                             "disk"};
  }
  if (!json.contains("files") || !json["files"].is_array()) return Error{origin, "files must be a list"};
  for (std::size_t i = 0; i < json["files"].size(); ++i) {
    const Json& entry = json["files"][i];
    const std::string owner = "files[" + std::to_string(i) + "]";
    if (!entry.is_object()) return Error{origin, owner + " must be a JSON object"};
    Reader read_entry(entry, owner + ".");
    FileEntry file{read_entry.text("name"), read_entry.text("sha256"), std::nullopt};
    if (read_entry.has("rows")) file.rows = read_entry.whole<std::int64_t>("rows");
    if (!read_entry.error().empty()) return Error{origin, read_entry.error()};
    manifest.files.push_back(std::move(file));
  }
  return manifest;
}

}  // namespace lukou::results
