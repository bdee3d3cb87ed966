#include "services/lukou/report/plots/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/core/contract.hpp"
#include "common/core/step.hpp"
#include "scenario.pb.h"
#include "services/lukou/report/figure/axis.hpp"

namespace lukou::report {

double end_s(const Result& result) {
  if (result.manifest()) return time_s(result.manifest()->complete_to_step);
  return result.scenario().message().run().duration_s();
}

double warmup_s(const Result& result) { return result.scenario().message().run().warmup_s(); }

Window whole_run(const Result& result, const PlotOptions& options) {
  return {options.from_s.value_or(0.0), options.to_s.value_or(end_s(result))};
}

Window stretch(const Result& result, const PlotOptions& options, double length_s) {
  const double end = end_s(result);
  const double begin = std::max(0.0, std::min(warmup_s(result), end - length_s));
  const double from = options.from_s.value_or(options.to_s ? std::max(0.0, *options.to_s - length_s) : begin);
  return {from, options.to_s.value_or(std::max(from + 1.0, std::min(end, from + length_s)))};
}

std::vector<figure::Point> thinned(const std::vector<figure::Point>& series, std::size_t most) {
  if (series.size() <= most) return series;
  std::vector<figure::Point> kept;
  const std::size_t stretches = std::max<std::size_t>(1, most / 2);
  for (std::size_t i = 0; i < stretches; ++i) {
    const auto from = series.begin() + static_cast<std::ptrdiff_t>(i * series.size() / stretches);
    const auto to = series.begin() + static_cast<std::ptrdiff_t>((i + 1) * series.size() / stretches);
    const auto [low, high] = std::ranges::minmax_element(from, to, {}, &figure::Point::y);
    kept.push_back(*std::min(low, high));
    if (low != high) kept.push_back(*std::max(low, high));
  }
  if (kept.back().x < series.back().x) kept.push_back(series.back());
  return kept;
}

std::vector<figure::Point> Histogram::outline(std::size_t of) const {
  std::vector<figure::Point> points{{from, 0.0}};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double share = of == 0 ? 0.0 : static_cast<double>(counts[i]) / static_cast<double>(of);
    points.push_back({from + static_cast<double>(i) * width, share});
  }
  points.push_back({to(), 0.0});
  return points;
}

Histogram histogram(const std::vector<double>& values, int bins) {
  LUKOU_EXPECT(!values.empty() && bins > 0);
  const auto [low, high] = std::ranges::minmax(values);
  Histogram like;
  like.width = figure::nice_step(std::max((high - low) / bins, 1e-6));
  like.from = std::floor(low / like.width) * like.width;
  like.counts.resize(static_cast<std::size_t>(std::floor((high - like.from) / like.width)) + 1);
  return histogram_like(values, like);
}

Histogram histogram_like(const std::vector<double>& values, const Histogram& like) {
  Histogram filled{like.from, like.width, std::vector<std::size_t>(like.counts.size(), 0)};
  for (const double value : values) {
    const double bin = std::floor((value - like.from) / like.width);
    ++filled.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(like.counts.size() - 1)))];
  }
  return filled;
}

double quantile(const std::vector<double>& sorted, double share) {
  LUKOU_EXPECT(!sorted.empty() && share > 0.0 && share <= 1.0);
  const double rank = std::ceil(share * static_cast<double>(sorted.size()) - 1e-9);
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

namespace says {

std::string lanes(const std::optional<Lane>& lane, Language language) {
  if (!lane) return Words{"all lanes", "全部车道"}.in(language);
  return kLane.in(language) + " " + std::string(name(*lane));
}

std::string from(Approach approach, Language language) {
  static const std::array<Words, kApproaches> kFrom = {{{"from the west", "西进口"},
                                                        {"from the south", "南进口"},
                                                        {"from the east", "东进口"},
                                                        {"from the north", "北进口"}}};
  return kFrom[index(approach)].in(language);
}

}  // namespace says

}  // namespace lukou::report
