#include <google/protobuf/text_format.h>

#include <algorithm>
#include <system_error>

#include "common/core/contract.hpp"
#include "common/core/hash.hpp"
#include "common/scenario/arrivals.hpp"
#include "common/scenario/check.hpp"
#include "common/scenario/defaults.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/setting.hpp"
#include "common/scenario/text_file.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

namespace fs = std::filesystem;
using google::protobuf::TextFormat;

/// A trace's relative path starts at `directory`; empty: where the program runs.
void make_absolute(Scenario& scenario, const fs::path& directory) {
  Traffic& traffic = *scenario.mutable_traffic();
  for (Demand* demand :
       {traffic.mutable_west(), traffic.mutable_south(), traffic.mutable_east(), traffic.mutable_north()}) {
    if (!demand->has_arrivals_csv() || fs::path(demand->arrivals_csv()).is_absolute()) continue;
    std::error_code code;
    const fs::path absolute = fs::absolute(directory / demand->arrivals_csv(), code);
    // If the working directory is gone the path stays relative, and reading it fails with its name.
    if (!code) demand->set_arrivals_csv(absolute.lexically_normal().string());
  }
}

/// Whether a path lies at or under a live field.
bool is_live(const FieldPath& path) {
  return std::any_of(path.begin(), path.end(),
                     [](const PathSegment& segment) { return rule_of(segment.field).live(); });
}

}  // namespace

Resolved::Resolved(std::unique_ptr<Scenario> message) : message_(std::move(message)) {}
Resolved::Resolved(const Resolved& other) : message_(std::make_unique<Scenario>(*other.message_)) {}
Resolved::Resolved(Resolved&& other) noexcept = default;
Resolved& Resolved::operator=(const Resolved& other) {
  if (this != &other) message_ = std::make_unique<Scenario>(*other.message_);
  return *this;
}
Resolved& Resolved::operator=(Resolved&& other) noexcept = default;
Resolved::~Resolved() = default;

/// The only maker of resolved scenarios.
class Loader {
 public:
  static Resolved resolved(Scenario message) { return Resolved(std::make_unique<Scenario>(std::move(message))); }
};

Expected<Resolved> load_text(const std::string& text, const std::string& origin, const fs::path& directory,
                             const std::vector<std::string>& sets) {
  std::vector<LabelledSet> labelled;
  for (const std::string& set : sets) {
    labelled.push_back({set, "--set " + set + " (" + ordinal(labelled.size() + 1) + " --set)"});
  }
  return load_text(text, origin, directory, labelled);
}

Expected<Resolved> load_text(const std::string& text, const std::string& origin, const fs::path& directory,
                             const std::vector<LabelledSet>& sets) {
  Scenario scenario;
  TextFile file(origin);
  // What stands in a file that cannot be read says nothing: its fields are not checked.
  if (auto read = file.parse_into(scenario, text); !read) return read.error();
  make_absolute(scenario, directory);

  std::vector<Placed> errors;
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto path = set_field(scenario, sets[i].set);
    settings.push_back({path ? path.value() : FieldPath{}, sets[i].label});
    if (!path) errors.push_back(placed(i, sets[i].label + ": " + path.error().what));
  }
  std::erase_if(settings, [](const Setting& setting) { return setting.path.empty(); });
  make_absolute(scenario, {});
  fill_defaults(scenario);
  for (const Finding& finding : check(scenario)) errors.push_back(file.placed(finding, settings));
  if (!errors.empty()) return as_error(std::move(errors));
  return Loader::resolved(std::move(scenario));
}

Expected<Resolved> load(const std::string& path_or_name, const std::vector<std::string>& sets) {
  const auto file = find_file(path_or_name, Shipped::kScenario);
  if (!file) return file.error();
  const auto content = read_file(file.value());
  if (!content) return Error{path_or_name, content.error().what};
  return load_text(content.value(), file.value().string(), file.value().parent_path(), sets);
}

std::vector<std::string> live_fields() {
  std::vector<std::string> fields;
  for_each_field(Scenario::descriptor(), "", [&](const std::string& path, const auto* field) {
    if (rule_of(field).live()) fields.push_back(path);
  });
  return fields;
}

Expected<Done> change(Resolved& scenario, const std::string& assignment) {
  Scenario changed = scenario.message();
  const auto path = set_field(changed, assignment);
  if (!path) return Error{assignment, path.error().what};
  if (!is_live(path.value())) {
    return Error{assignment,
                 text(path.value()) + " cannot change while a run goes on; these can: " + joined(live_fields(), ", ")};
  }
  fill_defaults(changed);
  std::vector<std::string> wrong;
  for (const Finding& finding : check(changed)) wrong.push_back(finding.what);
  if (!wrong.empty()) return Error{assignment, joined(wrong, "\n")};
  scenario = Loader::resolved(std::move(changed));
  return Done{};
}

std::string text(const Resolved& scenario) {
  TextFormat::Printer printer;
  printer.SetUseUtf8StringEscaping(true);
  std::string text;
  LUKOU_EXPECT(printer.PrintToString(scenario.message(), &text));
  return text;
}

std::string hash(const Resolved& scenario) { return sha256_hex(text(scenario)); }

}  // namespace lukou::scenario
