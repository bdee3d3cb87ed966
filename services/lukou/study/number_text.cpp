#include "services/lukou/study/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace lukou::studies {
namespace {

using statistics::Estimate;

/// Decimals that show two digits of a half width, at most four.
int decimals_of(const Estimate& estimate) {
  const double size = estimate.half_width.value_or(std::abs(estimate.mean) / 100.0);
  if (!(size > 0.0)) return 2;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(size))), 0, 4);
}

}  // namespace

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  // Rounded away to nothing: no sign.
  const std::string said = text.data();
  return said.find_first_not_of("-0.") == std::string::npos && said[0] == '-' ? said.substr(1) : said;
}

std::string percent_text(const Estimate& share) {
  const Estimate percent{share.n, 100.0 * share.mean, 100.0 * share.deviation,
                         share.half_width ? std::optional(100.0 * *share.half_width) : std::nullopt};
  const int decimals = std::min(2, decimals_of(percent));
  std::string text = fixed(percent.mean, decimals) + " %";
  if (percent.half_width) text += " [" + fixed(percent.low(), decimals) + ", " + fixed(percent.high(), decimals) + "]";
  return text;
}

std::string value_text(const Estimate& value, const std::string& unit) {
  const int decimals = decimals_of(value);
  std::string text = fixed(value.mean, decimals);
  if (value.half_width) text += " ± " + fixed(*value.half_width, decimals);
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace lukou::studies
