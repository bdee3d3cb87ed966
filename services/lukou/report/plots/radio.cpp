// What the radio did: delivery and latency over time, losses by cause.

#include <algorithm>
#include <array>
#include <cmath>

#include "common/results/radio_table.hpp"
#include "services/lukou/report/figure/axis.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

struct Cause {
  std::string_view column;
  Words name;
};
const std::array<Cause, 7>& causes() {
  static const std::array<Cause, 7> kCauses = {{{"lost_random", {"random", "随机"}},
                                                {"lost_burst", {"burst", "突发"}},
                                                {"lost_range", {"out of range", "超出距离"}},
                                                {"lost_path_loss", {"too weak", "信号太弱"}},
                                                {"lost_collision", {"collision", "碰撞"}},
                                                {"lost_half_duplex", {"half duplex", "半双工"}},
                                                {"lost_outage", {"outage", "中断"}}}};
  return kCauses;
}

struct Direction {
  std::string_view name;  ///< as in radio.csv
  Words says;
};
const std::array<Direction, 3>& directions() {
  static const std::array<Direction, 3> kDirections = {{{"uplink", {"car to RSU", "车到路侧"}},
                                                        {"downlink", {"RSU to car", "路侧到车"}},
                                                        {"v2v", {"car to car", "车到车"}}}};
  return kDirections;
}

/// Sums over a stretch of time.
struct Sums {
  double sent = 0.0;
  double lost = 0.0;
  double heard = 0.0;
  double latency_ms = 0.0;      ///< times `heard`
  double latency_p95_ms = 0.0;  ///< the same
  double busy = 0.0;            ///< times `seconds`
  double seconds = 0.0;         ///< with a busy ratio

  [[nodiscard]] double delivered() const { return sent > 0.0 ? 1.0 - lost / sent : NAN; }
};

struct Radio {
  Window window;
  double stretch_s = 1.0;
  std::array<std::vector<Sums>, 3> over_time;   ///< by direction and stretch
  std::array<std::array<double, 7>, 3> lost{};  ///< by direction and cause
  std::array<double, 3> sent{};
};

figure::Figure over_time(const Radio& radio, const Words& title, const Words& label, const std::string& unit,
                         Language language, const std::vector<std::pair<Words, double (*)(const Sums&)>>& lines) {
  figure::Figure figure;
  figure.title = title.in(language);
  figure.x = {.label = says::kTime.in(language), .unit = "s", .min = radio.window.from_s, .max = radio.window.to_s};
  figure.y = {.label = label.in(language), .unit = unit, .min = 0.0};
  int look = 0;
  for (std::size_t direction = 0; direction < directions().size(); ++direction) {
    for (const auto& [name, of] : lines) {
      figure::Line line{
          .name = directions()[direction].says.in(language) + name.in(language), .points = {}, .look = look};
      for (std::size_t i = 0; i < radio.over_time[direction].size(); ++i) {
        const double middle_s = radio.window.from_s + (static_cast<double>(i) + 0.5) * radio.stretch_s;
        line.points.push_back({middle_s, of(radio.over_time[direction][i])});
      }
      const bool any = std::ranges::any_of(line.points, [](const figure::Point& p) { return std::isfinite(p.y); });
      if (any) figure.layers.emplace_back(std::move(line));
      ++look;
    }
  }
  const std::string each = fixed(radio.stretch_s, 0);
  figure.subtitle = Words{"each point over " + each + " s", "每点为 " + each + " 秒的统计"}.in(language);
  return figure;
}

figure::Figure losses(const Radio& radio, Language language) {
  figure::Figure figure;
  figure.title = Words{"Losses by cause", "按原因的丢失"}.in(language);
  figure.x = {.label = Words{"share of the frames sent", "占发送帧的比例"}.in(language), .unit = "%", .min = 0.0};
  std::vector<std::size_t> shown;
  for (std::size_t cause = causes().size(); cause-- > 0;) {
    const auto any = [&](std::size_t direction) { return radio.lost[direction][cause] > 0.0; };
    if (any(0) || any(1) || any(2)) shown.push_back(cause);
  }
  for (const std::size_t cause : shown) figure.y.names.push_back(causes()[cause].name.in(language));
  if (shown.empty()) figure.y.names.push_back(Words{"none lost", "无丢失"}.in(language));
  std::vector<std::size_t> used;
  for (std::size_t direction = 0; direction < directions().size(); ++direction) {
    if (radio.sent[direction] > 0.0) used.push_back(direction);
  }
  const double width = 0.8 / static_cast<double>(std::max<std::size_t>(1, used.size()));
  for (std::size_t n = 0; n < used.size(); ++n) {
    const std::size_t direction = used[n];
    figure::Bars bars{.name = directions()[direction].says.in(language),
                      .bars = {},
                      .width = width,
                      .horizontal = true,
                      .look = static_cast<int>(direction)};
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const double share = 100.0 * radio.lost[direction][shown[i]] / radio.sent[direction];
      bars.bars.push_back({static_cast<double>(i) + 0.4 - width * (static_cast<double>(n) + 0.5), 0.0, share});
    }
    figure.layers.emplace_back(std::move(bars));
  }
  return figure;
}

/// A readable number of seconds, so that a line has some 150 points.
double stretch_for(const Window& window) { return std::max(1.0, figure::nice_step(window.length_s() / 150.0)); }

}  // namespace

Expected<Drawing> draw_radio(const Result& result, const PlotOptions& options) {
  if (!result.holds(results::kRadioTable)) {
    return Error{result.folder().string(),
                 "holds no radio.csv: the radio was the ideal one; `lukou run SCENARIO --set radio.preset=PC5_MODE4` "
                 "models it"};
  }
  Radio radio{.window = whole_run(result, options)};
  radio.stretch_s = stretch_for(radio.window);
  const auto stretches = static_cast<std::size_t>(std::ceil(radio.window.length_s() / radio.stretch_s));
  for (auto& sums : radio.over_time) sums.resize(std::max<std::size_t>(1, stretches));
  std::vector<std::string_view> columns{"time_s",          "direction",      "sent",      "heard",
                                        "latency_mean_ms", "latency_p95_ms", "busy_ratio"};
  for (const Cause& cause : causes()) columns.push_back(cause.column);
  const auto read = for_each_row(result.folder() / results::kRadioTable, columns, [&](const TableRow& row) {
    const auto found = std::ranges::find(directions(), row.text(1), &Direction::name);
    // A row speaks of the second that ends with it.
    const double middle_s = row.real(0) - 0.5;
    if (found == directions().end() || !radio.window.holds(middle_s)) return;
    const auto direction = static_cast<std::size_t>(found - directions().begin());
    const auto place = static_cast<std::size_t>((middle_s - radio.window.from_s) / radio.stretch_s);
    Sums& sums = radio.over_time[direction][std::min(place, radio.over_time[direction].size() - 1)];
    sums.sent += row.real(2);
    radio.sent[direction] += row.real(2);
    for (std::size_t cause = 0; cause < causes().size(); ++cause) {
      sums.lost += row.real(7 + cause);
      radio.lost[direction][cause] += row.real(7 + cause);
    }
    if (std::isfinite(row.real(6))) {
      sums.busy += row.real(6);
      sums.seconds += 1.0;
    }
    if (!std::isfinite(row.real(4))) return;
    sums.heard += row.real(3);
    sums.latency_ms += row.real(3) * row.real(4);
    sums.latency_p95_ms += row.real(3) * row.real(5);
  });
  if (!read) return read.error();
  return Drawing([radio](Language language) {
    const auto delivered = [](const Sums& sums) { return sums.delivered(); };
    const auto mean_ms = [](const Sums& sums) { return sums.latency_ms / sums.heard; };
    const auto p95_ms = [](const Sums& sums) { return sums.latency_p95_ms / sums.heard; };
    const auto busy = [](const Sums& sums) { return sums.busy / sums.seconds; };
    Panels panels;
    panels.figures.push_back(over_time(radio, {"Delivery", "送达率"}, {"frames not lost", "未丢失帧的比例"}, {},
                                       language, {{{"", ""}, delivered}}));
    panels.figures.back().y.max = 1.0;
    panels.figures.push_back(over_time(radio, {"Latency", "时延"}, {"latency", "时延"}, "ms", language,
                                       {{{", mean", "，平均"}, mean_ms}, {{", 95 % within", "，95% 不超过"}, p95_ms}}));
    panels.figures.push_back(losses(radio, language));
    figure::Figure load = over_time(radio, {"Load of the channel", "信道负载"}, {"share in use", "占用比例"}, {},
                                    language, {{{"", ""}, busy}});
    if (!load.layers.empty()) panels.figures.push_back(std::move(load));
    return panels;
  });
}

}  // namespace lukou::report
