#include "services/lukou/report/page/charts.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/core/contract.hpp"

namespace lukou::report {
namespace {

using Json = nlohmann::ordered_json;

Json both(const std::string& english, const std::string& chinese) { return {{"en", english}, {"zh", chinese}}; }

/// Six digits say more than any screen shows.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0;
  const double scale = std::pow(10.0, 6.0 - std::ceil(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

bool rises(const figure::Line& line) {
  double before = -INFINITY;
  for (const figure::Point& point : line.points) {
    if (!(point.x >= before)) return false;
    before = point.x;
  }
  return true;
}

/// Whether a chart of lines can show the layer, or may leave it out.
bool fits(const figure::Layer& layer) {
  if (const auto* line = std::get_if<figure::Line>(&layer)) return rises(*line);
  if (const auto* rule = std::get_if<figure::Rule>(&layer)) return rule->vertical;
  return std::holds_alternative<figure::Boxes>(layer) || std::holds_alternative<figure::Band>(layer);
}

Json dashes_of(const figure::Line& line) {
  Json dashes = Json::array();
  if (line.colour) return dashes;
  std::istringstream text{std::string(figure::look_of(line.look).dashes)};
  for (double length = 0.0; text >> length;) dashes.push_back(length);
  return dashes;
}

Json line_of(const figure::Line& english, const figure::Line& chinese) {
  Json x = Json::array();
  Json y = Json::array();
  for (const figure::Point& point : english.points) {
    // Two values at one place: the chart's lines have one. The later one stands.
    if (!x.empty() && x.back() == number(point.x)) {
      y.back() = number(point.y);
      continue;
    }
    x.push_back(number(point.x));
    y.push_back(number(point.y));
  }
  const figure::Colour colour = english.colour.value_or(figure::look_of(english.look).colour);
  return {{"name", both(english.name, chinese.name)},
          {"colour", figure::hex(colour)},
          {"dash", dashes_of(english)},
          {"steps", english.steps},
          {"x", std::move(x)},
          {"y", std::move(y)}};
}

}  // namespace

std::optional<nlohmann::ordered_json> chart_of(const figure::Figure& english, const figure::Figure& chinese) {
  LUKOU_EXPECT(english.layers.size() == chinese.layers.size());
  if (!english.x.names.empty() || !english.y.names.empty() || !std::ranges::all_of(english.layers, fits)) {
    return std::nullopt;
  }
  Json lines = Json::array();
  Json marks = Json::array();
  for (std::size_t i = 0; i < english.layers.size(); ++i) {
    if (const auto* line = std::get_if<figure::Line>(&english.layers[i])) {
      lines.push_back(line_of(*line, std::get<figure::Line>(chinese.layers[i])));
    } else if (const auto* rule = std::get_if<figure::Rule>(&english.layers[i])) {
      marks.push_back({{"name", both(rule->name, std::get<figure::Rule>(chinese.layers[i]).name)},
                       {"at", number(rule->at)},
                       {"colour", figure::hex(rule->colour)}});
    }
  }
  if (lines.empty()) return std::nullopt;
  return Json{{"title", both(english.title, chinese.title)},
              {"subtitle", both(english.subtitle, chinese.subtitle)},
              {"x", both(title(english.x), title(chinese.x))},
              {"y", both(title(english.y), title(chinese.y))},
              {"xMin", number(english.x.min)},
              {"xMax", number(english.x.max)},
              {"yMin", number(english.y.min)},
              {"lines", std::move(lines)},
              {"marks", std::move(marks)}};
}

}  // namespace lukou::report
