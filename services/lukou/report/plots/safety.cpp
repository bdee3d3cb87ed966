// Dangerous encounters: how many per driven hour, and how near.

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "common/measures/surrogate_safety.hpp"
#include "common/results/event_tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

using Json = nlohmann::ordered_json;

struct Kind {
  const char* key;  ///< in summary.json
  Words name;
};
const std::array<Kind, 7>& kinds() {
  static const std::array<Kind, 7> kKinds = {{{"ttc", {"TTC < 3 s", "TTC < 3 s"}},
                                              {"ttc_critical", {"TTC < 1.5 s", "TTC < 1.5 s"}},
                                              {"mttc", {"MTTC < 3 s", "MTTC < 3 s"}},
                                              {"drac", {"DRAC ≥ 3 m/s²", "DRAC ≥ 3 m/s²"}},
                                              {"hard_braking", {"braking ≤ −3 m/s²", "制动 ≤ −3 m/s²"}},
                                              {"jerk", {"jerk > 3 m/s³", "加加速度 > 3 m/s³"}},
                                              {"pet", {"PET < 2 s", "PET < 2 s"}}}};
  return kKinds;
}

struct Group {
  const char* key;
  const Words* name;
  int look;
};
constexpr std::size_t kGroups = 3;
const std::array<Group, kGroups>& groups() {
  static const Words kGuided{"with advice in force", "建议生效中的车辆"};
  static const std::array<Group, kGroups> kAll = {
      {{"equipped", &says::kEquipped, 0}, {"unequipped", &says::kUnequipped, 1}, {"guided", &kGuided, 2}}};
  return kAll;
}

struct Safety {
  std::array<std::array<double, 7>, kGroups> per_hour{};  ///< encounters per hour driven, by group and kind
  std::array<bool, kGroups> driven{};
  std::int64_t opposed_lefts = 0;
  std::array<std::vector<double>, kGroups> ttc_s;  ///< sorted
  std::array<double, kGroups> hours{};
};

figure::Figure rates(const Safety& safety, Language language) {
  figure::Figure figure;
  figure.title = Words{"Encounters per hour driven", "每行驶小时的危险交会"}.in(language);
  const std::string lefts = grouped(safety.opposed_lefts);
  figure.subtitle = Words{"without opposed left turns, which do not wait here: " + lefts + " with PET < 2 s",
                          "不含对向左转（本模型中不让行）：PET < 2 s 共 " + lefts + " 次"}
                        .in(language);
  figure.x = {.label = Words{"encounters per vehicle-hour", "每车小时交会次数"}.in(language), .unit = {}, .min = 0.0};
  for (std::size_t kind = kinds().size(); kind-- > 0;) figure.y.names.push_back(kinds()[kind].name.in(language));
  const auto used = static_cast<double>(std::ranges::count(safety.driven, true));
  const double width = 0.8 / std::max(1.0, used);
  int place = 0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    if (!safety.driven[group]) continue;
    figure::Bars bars{.name = groups()[group].name->in(language),
                      .bars = {},
                      .width = width,
                      .horizontal = true,
                      .look = groups()[group].look};
    for (std::size_t kind = 0; kind < kinds().size(); ++kind) {
      const double row = static_cast<double>(kinds().size() - 1 - kind) + 0.4 - width * (place + 0.5);
      bars.bars.push_back({row, 0.0, safety.per_hour[group][kind]});
    }
    figure.layers.emplace_back(std::move(bars));
    ++place;
  }
  return figure;
}

figure::Figure nearness(const Safety& safety, Language language) {
  figure::Figure figure;
  figure.title = Words{"How near: least time to collision", "接近程度：最小碰撞时间"}.in(language);
  figure.subtitle =
      Words{"encounters with at most this TTC, per hour driven", "TTC 不超过该值的交会，每行驶小时"}.in(language);
  figure.x = {.label = "TTC", .unit = "s", .min = 0.0, .max = kTtc_s};
  figure.y = {.label = Words{"encounters per vehicle-hour", "每车小时交会次数"}.in(language), .unit = {}, .min = 0.0};
  figure.layers.push_back(figure::Rule{.name = Words{"critical, 1.5 s", "临界值 1.5 s"}.in(language),
                                       .at = kTtcCritical_s,
                                       .vertical = true,
                                       .colour = figure::kGrey});
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::vector<double>& values = safety.ttc_s[group];
    if (!safety.driven[group]) continue;
    figure::Line line{.name = groups()[group].name->in(language),
                      .points = {{0.0, 0.0}},
                      .look = groups()[group].look,
                      .steps = true};
    for (std::size_t i = 0; i < values.size(); ++i) {
      line.points.push_back({values[i], static_cast<double>(i + 1) / safety.hours[group]});
    }
    line.points.push_back({kTtc_s, line.points.back().y});
    line.points = thinned(line.points, 600);
    figure.layers.emplace_back(std::move(line));
  }
  return figure;
}

}  // namespace

Expected<Drawing> draw_safety(const Result& result, const PlotOptions& /*options*/) {
  const auto summary = result.need_summary();
  if (!summary) return summary.error();
  if (!summary.value()->contains("safety")) {
    return Error{result.folder().string(),
                 "has no safety figures; record them with `lukou run SCENARIO --set record.safety=true` (the default)"};
  }
  const Json& json = (*summary.value())["safety"];
  Safety safety;
  safety.opposed_lefts = json["opposed_lefts"].value("pet", std::int64_t{0});
  for (std::size_t group = 0; group < kGroups; ++group) {
    const Json& counts = json[groups()[group].key];
    safety.hours[group] = counts.value("driven_s", 0.0) / 3600.0;
    safety.driven[group] = safety.hours[group] > 0.0;
    for (std::size_t kind = 0; safety.driven[group] && kind < kinds().size(); ++kind) {
      safety.per_hour[group][kind] = counts.value(kinds()[kind].key, 0.0) / safety.hours[group];
    }
  }
  const auto table = result.table(results::kSafetyTable, "--set record.safety=true (the default)");
  if (!table) return table.error();
  const auto read = for_each_row(table.value(), {"kind", "equipped", "guided", "value"}, [&](const TableRow& row) {
    if (row.text(0) != "ttc") return;
    safety.ttc_s[row.whole(1) != 0 ? 0 : 1].push_back(row.real(3));
    if (row.whole(2) != 0) safety.ttc_s[2].push_back(row.real(3));
  });
  if (!read) return read.error();
  for (std::vector<double>& values : safety.ttc_s) std::ranges::sort(values);
  return Drawing([safety = std::move(safety)](Language language) {
    return Panels{.figures = {rates(safety, language), nearness(safety, language)}};
  });
}

}  // namespace lukou::report
