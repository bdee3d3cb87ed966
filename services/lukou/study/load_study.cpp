#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <set>

#include "common/core/hash.hpp"
#include "common/results/event_tables.hpp"
#include "common/results/radio_table.hpp"
#include "common/results/tables.hpp"
#include "common/scenario/defaults.hpp"
#include "common/scenario/text_file.hpp"
#include "common/scenario/wording.hpp"
#include "services/lukou/study/plan.hpp"
#include "services/lukou/study/study_reader.hpp"
#include "study.pb.h"

namespace lukou::studies {
namespace {

namespace fs = std::filesystem;
using google::protobuf::TextFormat;
using scenario::TextFile;

constexpr std::size_t kRunsMax = 1'000'000;
constexpr std::size_t kErrorsMax = 12;  ///< of the scenarios of its points

/// Whether every scenario that the study asks for can run.
Expected<Done> check_points(const Study& study) {
  const Plan plan = plan_of(study);
  const std::size_t seeds = study.precision ? study.precision->at_most : study.seeds;
  if (plan.points.size() * seeds > kRunsMax) {
    return Error{study.name, std::to_string(plan.points.size()) + " points with " + std::to_string(seeds) +
                                 " seeds each are more than a million runs"};
  }
  std::vector<std::string> lines;
  std::set<std::string> seen;
  for (const Point& point : plan.points) {
    const auto scenario = scenario_of(study, point, study.first_seed);
    if (scenario) continue;
    const std::string text = scenario.error().text();
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t to = std::min(text.find('\n', from), text.size());
      if (seen.insert(text.substr(from, to - from)).second) lines.push_back(text.substr(from, to - from));
      from = to + 1;
    }
  }
  if (lines.empty()) return Done{};
  if (lines.size() > kErrorsMax) {
    const std::size_t more = lines.size() - kErrorsMax;
    lines.resize(kErrorsMax);
    lines.push_back("... and " + std::to_string(more) + " more");
  }
  return Error{"", scenario::joined(lines, "\n")};
}

/// The base scenario: a file beside the study, or what `lukou run` would find.
Expected<fs::path> find_base(const std::string& name, const fs::path& directory) {
  std::error_code code;
  if (const fs::path beside = directory / name; fs::is_regular_file(beside, code)) return beside;
  return scenario::find_file(name, scenario::Shipped::kScenario);
}

std::string text_of(study::Study message) {
  message.set_scenario(kBaseFile);
  TextFormat::Printer printer;
  printer.SetUseUtf8StringEscaping(true);
  printer.SetUseShortRepeatedPrimitives(true);
  std::string text;
  printer.PrintToString(message, &text);
  return text;
}

/// How many fields of a message type stand in a text, at its top.
int fields_known(const std::string& text, google::protobuf::Message& message) {
  struct Silent final : google::protobuf::io::ErrorCollector {
    void AddError(int, int, const std::string&) override {}
  } silent;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&silent);
  parser.AllowUnknownField(true);
  parser.AllowPartialMessage(true);
  parser.ParseFromString(text, &message);
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  return static_cast<int>(fields.size());
}

}  // namespace

bool Factor::numeric() const {
  return std::ranges::all_of(levels, [](const Level& level) { return level.number.has_value(); });
}

Expected<Study> load(const std::string& path_or_name, const Additions& additions) {
  const auto path = scenario::find_file(path_or_name, scenario::Shipped::kStudy);
  if (!path) return path.error();
  const auto content = scenario::read_file(path.value());
  if (!content) return Error{path_or_name, content.error().what};
  TextFile file(path.value().string());
  study::Study message;
  if (auto parsed = file.parse_into(message, content.value()); !parsed) return parsed.error();
  const auto sets_of_file = static_cast<std::size_t>(message.set_size());
  for (const std::string& set : additions.sets) message.add_set(set);
  if (additions.seeds) message.mutable_seeds()->set_count(*additions.seeds);
  if (!message.has_name()) message.set_name(path.value().stem().string());
  scenario::fill_fallbacks(message);

  std::vector<scenario::Finding> findings = scenario::field_findings(message);
  Study study = plain_study(message, file, sets_of_file, findings);
  const auto base = find_base(message.scenario(), path.value().parent_path());
  if (!base && message.has_scenario()) {
    const auto* field = study::Study::descriptor()->FindFieldByName("scenario");
    findings.push_back({scenario::extended({}, field), {}, "scenario: " + base.error().text(), ""});
  }
  std::vector<scenario::Placed> errors;
  for (const scenario::Finding& finding : findings) errors.push_back(file.placed(finding));
  if (!errors.empty()) return scenario::as_error(std::move(errors));

  const auto base_text = scenario::read_file(base.value());
  if (!base_text) return base_text.error();
  study.base_text = base_text.value();
  study.base_origin = base.value().string();
  study.base_directory = base.value().parent_path();
  study.text = text_of(message);
  message.mutable_seeds()->clear_count();
  message.clear_precision();
  study.core = text_of(message) + study.base_text;
  if (auto valid = check_points(study); !valid) return valid.error();
  return study;
}

std::string hash(const Study& study) { return sha256_hex(study.text + study.base_text); }

bool is_study(const std::string& path_or_name) {
  std::error_code code;
  if (fs::is_regular_file(path_or_name, code)) {
    const auto content = scenario::read_file(path_or_name);
    if (!content) return false;
    study::Study as_study;
    scenario::Scenario as_scenario;
    return fields_known(content.value(), as_study) > fields_known(content.value(), as_scenario);
  }
  if (scenario::find_file(path_or_name, scenario::Shipped::kScenario)) return false;
  return scenario::find_file(path_or_name, scenario::Shipped::kStudy).ok();
}

std::vector<std::string> names_of_tables() {
  return {results::kCarTable,   results::kStopTable,     results::kRoadTable,   results::kStopTimeTable,
          results::kStopsTable, results::kGuidanceTable, results::kSafetyTable, results::kRequestsTable,
          results::kRadioTable, "directives.textproto",  "timing.json"};
}

std::vector<scenario::FieldDoc> field_docs() { return scenario::field_docs(*study::Study::descriptor()); }

}  // namespace lukou::studies
