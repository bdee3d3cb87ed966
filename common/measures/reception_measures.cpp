#include "common/measures/reception_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/core/contract.hpp"

namespace lukou {
namespace {

/// The value of rank ceil(percent / 100 * n). Requires sorted values, at least one.
double percentile(const std::vector<double>& sorted, std::size_t percent) {
  const std::size_t rank = (percent * sorted.size() + 99) / 100;
  return sorted[rank - 1];
}

}  // namespace

void ReceptionMeasures::add(const ReceptionReport& report) {
  LUKOU_EXPECT(report.well_formed());
  std::size_t next = 0;
  for (std::size_t row = 0; row < report.size(); ++row) {
    Gathered& gathered = gathered_[{report.direction[row], report.kind[row]}];
    gathered.figures.sent += report.sent[row];
    gathered.figures.heard += report.heard[row];
    gathered.figures.lost_random += report.lost_random[row];
    gathered.figures.lost_burst += report.lost_burst[row];
    gathered.figures.lost_range += report.lost_range[row];
    gathered.figures.lost_path_loss += report.lost_path_loss[row];
    gathered.figures.lost_collision += report.lost_collision[row];
    gathered.figures.lost_half_duplex += report.lost_half_duplex[row];
    gathered.figures.lost_outage += report.lost_outage[row];
    if (!std::isnan(report.busy_ratio[row])) {
      gathered.busy_sum += report.busy_ratio[row];
      ++gathered.busy_reports;
    }
    gathered.figures.duplicates += report.duplicates[row];
    const auto begin = report.latency_ms.begin() + static_cast<std::ptrdiff_t>(next);
    gathered.latency_ms.insert(gathered.latency_ms.end(), begin, begin + report.heard[row]);
    next += report.heard[row];
  }
}

std::vector<ReceptionFigures> ReceptionMeasures::take() {
  std::vector<ReceptionFigures> taken;
  for (auto& [key, gathered] : gathered_) {
    ReceptionFigures& figures = gathered.figures;
    figures.direction = static_cast<Direction>(key.first);
    figures.kind = static_cast<FrameKind>(key.second);
    if (std::vector<double>& values = gathered.latency_ms; !values.empty()) {
      std::ranges::sort(values);
      double sum_ms = 0.0;
      for (const double value : values) sum_ms += value;
      figures.latency_mean_ms = sum_ms / static_cast<double>(values.size());
      figures.latency_p95_ms = percentile(values, 95);
      figures.latency_p99_ms = percentile(values, 99);
    }
    if (gathered.busy_reports > 0) figures.busy_ratio = gathered.busy_sum / gathered.busy_reports;
    taken.push_back(figures);
    gathered = {};
  }
  return taken;
}

}  // namespace lukou
