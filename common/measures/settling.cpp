#include "common/measures/settling.hpp"

#include <cmath>

#include "common/core/contract.hpp"

namespace lukou {

std::optional<std::size_t> settled_from(std::span<const double> series, double share) {
  LUKOU_EXPECT(share > 0.0);
  if (series.empty() || !std::isfinite(series.back())) return std::nullopt;
  const double last = series.back();
  std::size_t from = series.size();
  while (from > 0 && std::abs(series[from - 1] - last) <= share * std::abs(last)) --from;
  return from;
}

}  // namespace lukou
