// How the delay is distributed over the cars.

#include <algorithm>
#include <array>

#include "common/results/tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

constexpr int kBins = 40;
constexpr std::size_t kGroups = 3;  ///< all, equipped, unequipped

struct Delays {
  std::array<std::vector<double>, kGroups> by_group;  ///< [s], sorted
  std::optional<Lane> lane;
  Window window;
};

const std::array<const Words*, kGroups> kNames = {&says::kAll, &says::kEquipped, &says::kUnequipped};
/// Blue for equipped and red-orange for unequipped cars, as everywhere; grey for all.
constexpr std::array<int, kGroups> kLooks = {6, 0, 1};

std::string subtitle(const Delays& delays, Language language) {
  const std::vector<double>& all = delays.by_group[0];
  const std::string mean_s = fixed(mean(all), 1);
  const std::string median_s = fixed(quantile(all, 0.5), 1);
  const std::string most_s = fixed(quantile(all, 0.95), 1);
  const std::string cars = grouped(static_cast<std::int64_t>(all.size()));
  return Words{says::lanes(delays.lane, language) + ", " + cars + " cars: mean " + mean_s + " s, median " + median_s +
                   " s, 95 % at most " + most_s + " s",
               says::lanes(delays.lane, language) + "，" + cars + " 辆车：均值 " + mean_s + " s，中位数 " + median_s +
                   " s，95% 不超过 " + most_s + " s"}
      .in(language);
}

figure::Figure frame(const Delays& delays, Language language) {
  figure::Figure figure;
  figure.x = {.label = Words{"delay", "延误"}.in(language), .unit = "s"};
  figure.title = Words{"Delay", "延误"}.in(language);
  figure.subtitle = subtitle(delays, language);
  return figure;
}

figure::Figure densities(const Delays& delays, Language language) {
  figure::Figure figure = frame(delays, language);
  const Histogram bins = histogram(delays.by_group[0], kBins);
  figure.x.min = bins.from;
  figure.x.max = bins.to();
  figure.y = {.label = Words{"share of cars", "车辆比例"}.in(language), .unit = {}, .min = 0.0};
  for (std::size_t group = 1; group < kGroups; ++group) {
    const std::vector<double>& values = delays.by_group[group];
    if (values.empty()) continue;
    const std::string mean_s = fixed(mean(values), 1);
    figure.layers.push_back(
        figure::Line{.name = kNames[group]->in(language) + Words{", mean ", "，均值 "}.in(language) + mean_s + " s",
                     .points = histogram_like(values, bins).outline(values.size()),
                     .look = kLooks[group],
                     .steps = true});
  }
  for (std::size_t group = 1; group < kGroups; ++group) {
    if (delays.by_group[group].empty()) continue;
    figure.layers.push_back(figure::Rule{.name = {},
                                         .at = mean(delays.by_group[group]),
                                         .vertical = true,
                                         .colour = figure::look_of(kLooks[group]).colour});
  }
  return figure;
}

/// The share of cars with at most so much delay, at about 200 places.
std::vector<figure::Point> distribution(const std::vector<double>& sorted) {
  std::vector<figure::Point> points{{sorted.front(), 0.0}};
  constexpr std::size_t kPlaces = 200;
  for (std::size_t i = 1; i <= kPlaces; ++i) {
    const double share = static_cast<double>(i) / kPlaces;
    points.push_back({quantile(sorted, share), share});
  }
  return points;
}

figure::Figure distributions(const Delays& delays, Language language) {
  figure::Figure figure = frame(delays, language);
  figure.title = Words{"Cumulative distribution of the delay", "延误的累积分布"}.in(language);
  figure.x.min = delays.by_group[0].front();
  figure.y = {.label = Words{"share of cars", "车辆比例"}.in(language), .unit = {}, .min = 0.0, .max = 1.0};
  for (std::size_t group = 0; group < kGroups; ++group) {
    if (delays.by_group[group].empty()) continue;
    figure.layers.push_back(figure::Line{
        .name = kNames[group]->in(language), .points = distribution(delays.by_group[group]), .look = kLooks[group]});
  }
  return figure;
}

}  // namespace

Expected<Drawing> draw_delay(const Result& result, const PlotOptions& options) {
  const auto table = result.table(results::kCarTable, "(always)");
  if (!table) return table.error();
  Delays delays{.by_group = {}, .lane = options.lane, .window = whole_run(result, options)};
  // As the summary's mean: cars that entered after the warm-up and have left.
  const double from_s = options.from_s.value_or(warmup_s(result));
  const auto read = for_each_row(table.value(), {"lane", "equipped", "entered_s", "delay_s"}, [&](const TableRow& row) {
    if (options.lane && row.text(0) != name(*options.lane)) return;
    if (row.real(2) < from_s || row.real(2) > delays.window.to_s) return;
    delays.by_group[0].push_back(row.real(3));
    delays.by_group[row.whole(1) != 0 ? 1 : 2].push_back(row.real(3));
  });
  if (!read) return read.error();
  if (delays.by_group[0].empty()) {
    return Error{table.value().string(), "has no car that entered from " + fixed(from_s, 0) + " s (the warm-up) to " +
                                             fixed(delays.window.to_s, 0) + " s; choose other times by --from, --to"};
  }
  for (std::vector<double>& values : delays.by_group) std::ranges::sort(values);
  return Drawing([delays = std::move(delays)](Language language) {
    return Panels{.figures = {densities(delays, language), distributions(delays, language)}};
  });
}

}  // namespace lukou::report
