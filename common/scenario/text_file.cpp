#include "common/scenario/text_file.hpp"

#include <algorithm>

#include "common/scenario/parse.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::TextFormat;

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

}  // namespace

Placed placed(std::size_t setting, const std::string& line) { return {{2, setting, 0}, line}; }

Error as_error(std::vector<Placed> errors) {
  std::stable_sort(errors.begin(), errors.end(), [](const Placed& a, const Placed& b) { return a.order < b.order; });
  std::vector<std::string> lines;
  for (const Placed& error : errors) lines.push_back(error.line);
  return Error{"", joined(lines, "\n")};
}

Expected<Done> TextFile::parse_into(google::protobuf::Message& message, const std::string& text) {
  std::vector<Placed> errors;
  for (const ParseIssue& issue : parse(text, message, places_)) {
    errors.push_back({{0, static_cast<std::size_t>(issue.line), issue.column},
                      at(origin_, issue.line, issue.column) + ": " + issue.what});
  }
  if (!errors.empty()) return as_error(std::move(errors));
  return Done{};
}

std::string TextFile::where(const FieldPath& path) const {
  const TextFormat::ParseLocation place = location(places_, path).place;
  return at(origin_, place.line + 1, place.column + 1);
}

Placed TextFile::placed(const Finding& finding, const std::vector<Setting>& settings) const {
  const std::size_t set = setting_behind(finding, settings);
  if (set < settings.size()) {
    const std::string where = finding.where.empty() ? "" : finding.where + ": ";
    return scenario::placed(set, settings[set].label + ": " + where + finding.what);
  }
  Location found = location(places_, finding.path);
  for (const FieldPath& other : finding.also) {
    const Location there = location(places_, other);
    if (!found.exact && there.exact) found = there;
  }
  const TextFormat::ParseLocation place = found.place;
  const std::string where = finding.where.empty() ? at(origin_, place.line + 1, place.column + 1) : finding.where;
  const bool in_file = place.line >= 0;
  return {{in_file ? 0 : 1, static_cast<std::size_t>(in_file ? place.line : 0), place.column},
          where + ": " + finding.what};
}

}  // namespace lukou::scenario
