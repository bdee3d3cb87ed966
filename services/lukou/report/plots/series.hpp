#pragma once

#include <cstddef>
#include <vector>

#include "services/lukou/report/figure/figure.hpp"
#include "services/lukou/report/plots/plot.hpp"

// What several figures do with their numbers.

namespace lukou::report {

/// A stretch of simulated time.
struct Window {
  double from_s = 0.0;
  double to_s = 0.0;

  [[nodiscard]] bool holds(double at_s) const { return at_s >= from_s && at_s <= to_s; }
  [[nodiscard]] double length_s() const { return to_s - from_s; }
};

/// End of what the result holds [s]: of the manifest, else the scenario's.
double end_s(const Result& result);
/// The end of the warm-up [s].
double warmup_s(const Result& result);
/// The whole run, as far as the user has not cut it.
Window whole_run(const Result& result, const PlotOptions& options);
/// A stretch of about `length_s` after the warm-up, as far as the run holds one and the user has not chosen another.
Window stretch(const Result& result, const PlotOptions& options, double length_s);

/// A series over time with at most about `most` points, which keeps its peaks: of each stretch the smallest and the
/// largest value.
std::vector<figure::Point> thinned(const std::vector<figure::Point>& series, std::size_t most = 1200);

/// Number of values in each of equal bins.
struct Histogram {
  double from = 0.0;
  double width = 1.0;
  std::vector<std::size_t> counts;

  [[nodiscard]] double to() const { return from + width * static_cast<double>(counts.size()); }
  /// Share of the values in each bin over `of`, for a line of steps.
  [[nodiscard]] std::vector<figure::Point> outline(std::size_t of) const;
};
/// Bins of a readable width, about `bins` over the range of `values`. Requires values.
Histogram histogram(const std::vector<double>& values, int bins);
/// Bins as those of `like`; what lies beyond goes to the ends.
Histogram histogram_like(const std::vector<double>& values, const Histogram& like);
/// The value of rank ceil(share * n). Requires sorted values, and share within (0, 1].
double quantile(const std::vector<double>& sorted, double share);
double mean(const std::vector<double>& values);

/// Words that many figures use.
namespace says {
inline const Words kTime{"time", "时间"};
inline const Words kAll{"all cars", "全部车辆"};
inline const Words kEquipped{"equipped", "装载车辆"};
inline const Words kUnequipped{"unequipped", "未装载车辆"};
inline const Words kLane{"lane", "车道"};
inline const Words kRed{"red", "红灯"};
inline const Words kYellow{"yellow", "黄灯"};
inline const Words kGreen{"green", "绿灯"};
inline const Words kWarmup{"end of the warm-up", "预热结束"};
/// "lane WC" or "all lanes"
std::string lanes(const std::optional<Lane>& lane, Language language);
/// Approach as an adjective for a legend: "from the west".
std::string from(Approach approach, Language language);
}  // namespace says

}  // namespace lukou::report
