// What became of advice: its fates, and how old it was when it was first used.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/results/event_tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

struct Fate {
  const char* group;  ///< object of summary.json; null: a number of its own
  const char* key;
  Words name;
  figure::Colour colour;
};

constexpr figure::Colour kUsed{0, 158, 115};
constexpr figure::Colour kChanged{0, 114, 178};
constexpr figure::Colour kRefused{230, 159, 0};
constexpr figure::Colour kLost{213, 94, 0};

const std::vector<Fate>& fates() {
  static const std::vector<Fate> kFates = {
      {nullptr, "advice_applied", {"applied as commanded", "按指令执行"}, kUsed},
      {"advice_changed", "limit", {"changed: limit", "修改：限值"}, kChanged},
      {"advice_changed", "guard", {"changed: guard", "修改：安全防护"}, kChanged},
      {"advice_changed", "following", {"changed: following law", "修改：跟驰规律"}, kChanged},
      {"advice_changed", "red", {"changed: braking for red", "修改：红灯制动"}, kChanged},
      {"advice_changed", "driver", {"changed: driver", "修改：驾驶员"}, kChanged},
      {"advice_refused", "past_stop_line", {"refused: past the stop line", "拒绝：已过停车线"}, kRefused},
      {"advice_refused", "expired", {"refused: expired", "拒绝：过期"}, kRefused},
      {"advice_refused", "superseded", {"refused: superseded", "拒绝：被更新建议取代"}, kRefused},
      {"advice_refused", "unknown_vehicle", {"refused: unknown vehicle", "拒绝：车辆未知"}, kRefused},
      {"advice_refused", "malformed", {"refused: malformed", "拒绝：格式错误"}, kRefused},
      {"advice_refused", "limit", {"refused: beyond the limits", "拒绝：超出限值"}, kRefused},
      {"advice_refused", "late", {"refused: late", "拒绝：迟到"}, kRefused},
      {"advice_refused", "not_complied", {"refused: driver does not follow", "拒绝：驾驶员不遵从"}, kRefused},
      {"advice_lost", "random", {"lost: random", "丢失：随机"}, kLost},
      {"advice_lost", "burst", {"lost: burst", "丢失：突发"}, kLost},
      {"advice_lost", "range", {"lost: out of range", "丢失：超出距离"}, kLost},
      {"advice_lost", "path_loss", {"lost: too weak", "丢失：信号太弱"}, kLost},
      {"advice_lost", "collision", {"lost: collision", "丢失：碰撞"}, kLost},
      {"advice_lost", "half_duplex", {"lost: half duplex", "丢失：半双工"}, kLost},
      {"advice_lost", "outage", {"lost: outage", "丢失：中断"}, kLost},
      {"advice_dropped", "stale", {"dropped: stale", "丢弃：过时"}, kRefused},
  };
  return kFates;
}

struct Count {
  const Fate* fate = nullptr;
  std::int64_t count = 0;
};

struct Advice {
  std::int64_t sent = 0;
  std::vector<Count> counts;  ///< those above 0, in the order above
  std::vector<double> ages_s;
};

figure::Figure fates_of(const Advice& advice, Language language) {
  figure::Figure figure;
  figure.title = Words{"Fates of advice", "建议的去向"}.in(language);
  figure.subtitle = Words{"of " + grouped(advice.sent) + ", one per car and frame",
                          "共 " + grouped(advice.sent) + " 条建议，每帧每车一条"}
                        .in(language);
  figure.x = {.label = Words{"share of the advice", "占建议的比例"}.in(language), .unit = "%", .min = 0.0};
  double largest = 0.0;
  for (std::size_t row = 0; row < advice.counts.size(); ++row) {
    // The first stands on top.
    const Count& count = advice.counts[advice.counts.size() - 1 - row];
    figure.y.names.push_back(count.fate->name.in(language));
    const double share = 100.0 * static_cast<double>(count.count) / static_cast<double>(advice.sent);
    largest = std::max(largest, share);
    figure.layers.push_back(figure::Bars{.name = {},
                                         .bars = {{static_cast<double>(row), 0.0, share}},
                                         .horizontal = true,
                                         .colour = count.fate->colour});
  }
  figure.x.max = largest * 1.4;
  for (std::size_t row = 0; row < advice.counts.size(); ++row) {
    const std::int64_t count = advice.counts[advice.counts.size() - 1 - row].count;
    const double share = 100.0 * static_cast<double>(count) / static_cast<double>(advice.sent);
    figure.layers.push_back(
        figure::Note{.at = {share + largest * 0.02, static_cast<double>(row)}, .text = grouped(count)});
  }
  return figure;
}

figure::Figure ages_of(const Advice& advice, Language language) {
  figure::Figure figure;
  figure.title = Words{"Age of advice when it was first used", "建议首次使用时的时效"}.in(language);
  std::vector<double> sorted = advice.ages_s;
  std::ranges::sort(sorted);
  figure.subtitle = Words{"mean ", "均值 "}.in(language) + fixed(mean(sorted), 2) + " s, " +
                    Words{"95 % at most ", "95% 不超过 "}.in(language) + fixed(quantile(sorted, 0.95), 1) + " s";
  figure.x = {.label = Words{"age", "时效"}.in(language), .unit = "s", .min = -0.1};
  figure.y = {.label = Words{"share of the advice used", "占已使用建议的比例"}.in(language), .unit = {}, .min = 0.0};
  // Ages are whole tenths of a second.
  figure::Bars bars{.name = {}, .bars = {}, .width = 0.08};
  std::size_t from = 0;
  while (from < sorted.size()) {
    const auto to = static_cast<std::size_t>(std::ranges::upper_bound(sorted, sorted[from] + 0.01) - sorted.begin());
    bars.bars.push_back({sorted[from], 0.0, static_cast<double>(to - from) / static_cast<double>(sorted.size())});
    from = to;
  }
  figure.layers.emplace_back(std::move(bars));
  return figure;
}

}  // namespace

Expected<Drawing> draw_advice(const Result& result, const PlotOptions& /*options*/) {
  const auto summary = result.need_summary();
  if (!summary) return summary.error();
  const nlohmann::ordered_json& json = *summary.value();
  Advice advice{.sent = json.value("advice_sent", std::int64_t{0})};
  if (advice.sent == 0) {
    return Error{result.folder().string(),
                 "has no advice: its RSU gave none (algorithm `none`, signal control, or no car with a unit)"};
  }
  for (const Fate& fate : fates()) {
    std::int64_t count = 0;
    if (fate.group == nullptr) {
      count = json.value(fate.key, std::int64_t{0});
    } else if (json.contains(fate.group)) {
      count = json[fate.group].value(fate.key, std::int64_t{0});
    }
    if (count > 0) advice.counts.push_back({&fate, count});
  }
  if (result.holds(results::kGuidanceTable)) {
    const auto read =
        for_each_row(result.folder() / results::kGuidanceTable, {"age_s", "fate"}, [&](const TableRow& row) {
          if (std::isfinite(row.real(0)) && row.text(1) != kDeadlineMissed) advice.ages_s.push_back(row.real(0));
        });
    if (!read) return read.error();
  }
  return Drawing([advice = std::move(advice)](Language language) {
    Panels panels{.figures = {fates_of(advice, language)}};
    if (!advice.ages_s.empty()) panels.figures.push_back(ages_of(advice, language));
    // All panels of a picture have one size: that of the longest list of fates.
    const double height_mm = std::max(66.0, 34.0 + 5.0 * static_cast<double>(advice.counts.size()));
    for (figure::Figure& figure : panels.figures) figure.size = {figure::kOneColumn.width_mm, height_mm};
    return panels;
  });
}

}  // namespace lukou::report
