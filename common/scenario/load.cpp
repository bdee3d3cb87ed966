#include <google/protobuf/text_format.h>

#include <algorithm>
#include <system_error>
#include <tuple>

#include "common/core/contract.hpp"
#include "common/core/hash.hpp"
#include "common/scenario/arrivals.hpp"
#include "common/scenario/check.hpp"
#include "common/scenario/defaults.hpp"
#include "common/scenario/file.hpp"
#include "common/scenario/parse.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/setting.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

namespace fs = std::filesystem;
using google::protobuf::TextFormat;

/// A --set that has been applied.
struct Setting {
  FieldPath path;
  std::string label;
};

/// An error with the key that it is sorted by: the file from top to bottom, then defaults, then each --set.
struct Placed {
  std::tuple<int, std::size_t, int> order;
  std::string line;
};

std::string at(const std::string& origin, int line, int column) {
  return line < 1 ? origin : origin + ":" + std::to_string(line) + ":" + std::to_string(column);
}

/// Where something stands in the file.
struct Location {
  TextFormat::ParseLocation place;  ///< from 0; line -1 if nothing around the field stands in the file
  bool exact = false;               ///< the field itself, not only a message around it
};

/// Where a field stands in the file, or the nearest message around it that stands there.
Location location(const TextFormat::ParseInfoTree& root, const FieldPath& path) {
  const TextFormat::ParseInfoTree* tree = &root;
  TextFormat::ParseLocation found;
  for (const PathSegment& segment : path) {
    TextFormat::ParseLocation here = tree->GetLocation(segment.field, segment.index);
    // In the short form [a, b, c] only the first entry has a place.
    for (int i = segment.index - 1; here.line < 0 && i >= 0; --i) here = tree->GetLocation(segment.field, i);
    if (here.line < 0) break;
    found = here;
    if (&segment == &path.back()) return {found, true};
    tree = tree->GetTreeForNested(segment.field, segment.index);
    if (tree == nullptr) break;
  }
  return {found, false};
}

/// The last --set that has to do with a finding; settings.size() if none has.
std::size_t setting_behind(const Finding& finding, const std::vector<Setting>& settings) {
  const auto touches = [](const FieldPath& set, const FieldPath& path) {
    return begins_with(path, set) || begins_with(set, path);
  };
  for (std::size_t i = settings.size(); i-- > 0;) {
    if (touches(settings[i].path, finding.path)) return i;
    for (const FieldPath& other : finding.also) {
      if (touches(settings[i].path, other)) return i;
    }
  }
  return settings.size();
}

Placed placed(const Finding& finding, const std::string& origin, const TextFormat::ParseInfoTree& places,
              const std::vector<Setting>& settings) {
  const std::size_t set = setting_behind(finding, settings);
  if (set < settings.size()) {
    const std::string where = finding.where.empty() ? "" : finding.where + ": ";
    return {{2, set, 0}, settings[set].label + ": " + where + finding.what};
  }
  Location found = location(places, finding.path);
  for (const FieldPath& other : finding.also) {
    const Location there = location(places, other);
    if (!found.exact && there.exact) found = there;
  }
  const TextFormat::ParseLocation place = found.place;
  const std::string where = finding.where.empty() ? at(origin, place.line + 1, place.column + 1) : finding.where;
  const bool in_file = place.line >= 0;
  return {{in_file ? 0 : 1, static_cast<std::size_t>(in_file ? place.line : 0), place.column},
          where + ": " + finding.what};
}

Error as_error(std::vector<Placed> errors) {
  std::stable_sort(errors.begin(), errors.end(), [](const Placed& a, const Placed& b) { return a.order < b.order; });
  std::vector<std::string> lines;
  for (const Placed& error : errors) lines.push_back(error.line);
  return Error{"", joined(lines, "\n")};
}

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
  Scenario scenario;
  TextFormat::ParseInfoTree places;
  std::vector<Placed> errors;
  for (const ParseIssue& issue : parse(text, scenario, places)) {
    errors.push_back({{0, static_cast<std::size_t>(issue.line), issue.column},
                      at(origin, issue.line, issue.column) + ": " + issue.what});
  }
  // What stands in a file that cannot be read says nothing: its fields are not checked.
  if (!errors.empty()) return as_error(std::move(errors));
  make_absolute(scenario, directory);

  std::vector<Setting> settings;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string label = "--set " + sets[i] + " (" + ordinal(i + 1) + " --set)";
    const auto path = set_field(scenario, sets[i]);
    settings.push_back({path ? path.value() : FieldPath{}, label});
    if (!path) errors.push_back({{2, i, 0}, label + ": " + path.error().what});
  }
  std::erase_if(settings, [](const Setting& setting) { return setting.path.empty(); });
  make_absolute(scenario, {});
  fill_defaults(scenario);
  for (const Finding& finding : check(scenario)) errors.push_back(placed(finding, origin, places, settings));
  if (!errors.empty()) return as_error(std::move(errors));
  return Loader::resolved(std::move(scenario));
}

Expected<Resolved> load(const std::string& path_or_name, const std::vector<std::string>& sets) {
  const auto file = find_scenario(path_or_name);
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
