#include "services/lukou/compare/comparison_text.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "services/lukou/study/number_text.hpp"

namespace lukou::compare {
namespace {

using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;
using statistics::Estimate;

/// Columns that its letters take: UTF-8, each letter one wide.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] + 2 - width_of(row[i]), ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string p_text(double p) { return p < 0.0001 ? "< 0.0001" : studies::fixed(p, 4); }

/// "A lower by 85 % [84, 86]: better"
std::string verdict_of(const Judgement& judgement) {
  const studies::Comparison& found = judgement.found;
  const double difference = found.paired.difference.mean;
  if (!found.comparable) return "not comparable: an anomaly ended runs";
  if (difference == 0.0 && found.paired.difference.deviation == 0.0) return "equal";
  if (judgement.basis == Basis::kNone) return "one value each: no interval";
  if (!found.significant) return "no difference can be told";
  std::string text = difference < 0.0 ? "A lower" : "A higher";
  if (found.gain) {
    Estimate size = *found.gain;
    size.mean = std::abs(size.mean);
    text += " by " + studies::percent_text(size);
  }
  return text + ((difference < 0.0) == judgement.measure.less_is_better ? ": better" : ": worse");
}

Row row_of(const std::string& head, const Judgement& judgement) {
  const studies::Comparison& found = judgement.found;
  const bool tested = judgement.basis != Basis::kNone;
  return {head,
          studies::value_text(found.of_arm, ""),
          studies::value_text(found.of_baseline, ""),
          studies::value_text(found.paired.difference, ""),
          tested ? p_text(found.paired.p) : "-",
          verdict_of(judgement)};
}

Row head_of(const std::string& first) { return {first, "A", "B", "A - B", "p", ""}; }

Json known(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const Judgement& judgement) {
  const studies::Comparison& found = judgement.found;
  Json json = {{"measure", judgement.measure.path},
               {"unit", judgement.measure.unit},
               {"basis", name(judgement.basis)},
               {"n", found.paired.difference.n},
               {"a", found.of_arm.mean},
               {"a_half_width", known(found.of_arm.half_width)},
               {"b", found.of_baseline.mean},
               {"b_half_width", known(found.of_baseline.half_width)},
               {"difference", found.paired.difference.mean},
               {"difference_half_width", known(found.paired.difference.half_width)}};
  json["p"] = judgement.basis == Basis::kNone ? Json(nullptr) : Json(found.paired.p);
  json["significant"] = found.significant;
  json["gain"] = found.gain ? Json(found.gain->mean) : Json(nullptr);
  json["gain_half_width"] = found.gain ? known(found.gain->half_width) : Json(nullptr);
  json["correlation"] = known(found.paired.correlation);
  json["variance_gain"] = known(found.paired.variance_gain);
  return json;
}

}  // namespace

std::string text(const Comparison& comparison) {
  if (comparison.groups.size() == 1) {
    std::vector<Row> rows = {head_of("measure")};
    for (const Judgement& judgement : comparison.groups.front().measures) {
      rows.push_back(row_of(studies::title(judgement.measure), judgement));
    }
    return aligned(rows);
  }
  std::string text;
  const auto& measures = comparison.groups.front().measures;
  for (const Judgement& first : measures) {
    std::vector<Row> rows = {head_of(studies::title(first.measure))};
    for (const GroupJudgement& group : comparison.groups)
      for (const Judgement& judgement : group.measures) {
        if (judgement.measure.path == first.measure.path) rows.push_back(row_of(group.label, judgement));
      }
    text += (text.empty() ? "" : "\n") + aligned(rows);
  }
  return text;
}

Json json(const Comparison& comparison) {
  Json json = {{"groups", Json::array()}, {"warnings", comparison.warnings}};
  for (const GroupJudgement& group : comparison.groups) {
    Json measures = Json::array();
    for (const Judgement& judgement : group.measures) measures.push_back(json_of(judgement));
    json["groups"].push_back({{"label", group.label}, {"measures", measures}});
  }
  return json;
}

}  // namespace lukou::compare
