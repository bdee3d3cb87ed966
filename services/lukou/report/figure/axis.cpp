#include "services/lukou/report/figure/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/core/contract.hpp"

namespace lukou::figure {
namespace {

/// Shares of a step within which two numbers are the same tick.
constexpr double kSame = 1e-9;

double floor_to(double value, double step) { return std::floor(value / step + kSame) * step; }
double ceil_to(double value, double step) { return std::ceil(value / step - kSame) * step; }

/// 0.001, 1, 1000, and 1e6 beyond what is easily read.
std::string decade_text(double value) {
  if (value >= 1e-4 && value < 1e6) return tick_text(value, value);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "1e%d", static_cast<int>(std::lround(std::log10(value))));
  return text.data();
}

}  // namespace

std::string title(const Axis& axis) { return axis.unit.empty() ? axis.label : axis.label + " [" + axis.unit + "]"; }

void Extent::take(double value) {
  if (!std::isfinite(value)) return;
  if (!min || value < *min) min = value;
  if (!max || value > *max) max = value;
}

double nice_step(double step) {
  LUKOU_EXPECT(step > 0.0);
  const double decade = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * decade >= step * (1.0 - kSame)) return factor * decade;
  return 10.0 * decade;
}

std::string tick_text(double value, double step) {
  int decimals = 0;
  for (double rest = step; decimals < 9 && std::abs(rest - std::round(rest)) > 1e-6 * std::abs(rest); rest *= 10.0) {
    ++decimals;
  }
  if (std::abs(value) < step * kSame) value = 0.0;  // no "-0"
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, std::abs(value));
  return (value < 0.0 ? "\u2212" : "") + std::string(text.data());
}

AxisScale::AxisScale(const Axis& axis, const Extent& content, int ticks) : logarithmic_(axis.logarithmic) {
  LUKOU_EXPECT(ticks >= 2);
  if (!axis.names.empty()) {
    logarithmic_ = false;
    min_ = -0.5;
    max_ = static_cast<double>(axis.names.size()) - 0.5;
    for (std::size_t i = 0; i < axis.names.size(); ++i) ticks_.push_back({static_cast<double>(i), axis.names[i]});
  } else if (logarithmic_) {
    set_logarithmic(axis, content, ticks);
  } else {
    set_linear(axis, content, ticks);
  }
}

void AxisScale::set_linear(const Axis& axis, const Extent& content, int ticks) {
  min_ = axis.min.value_or(content.min.value_or(0.0));
  max_ = axis.max.value_or(content.max.value_or(1.0));
  if (!(min_ < max_)) {  // one value: some room around it
    const double room = std::max(1.0, std::abs(min_) * 0.1);
    if (!axis.min) min_ -= room;
    if (!axis.max || !(min_ < max_)) max_ = min_ + 2.0 * room;
  }
  const double step = nice_step((max_ - min_) / ticks);
  if (!axis.min) min_ = floor_to(min_, step);
  if (!axis.max) max_ = ceil_to(max_, step);
  const double first = ceil_to(min_, step);
  const auto count = static_cast<int>(std::floor((max_ - first) / step + kSame)) + 1;
  for (int i = 0; i < count; ++i) ticks_.push_back({first + i * step, tick_text(first + i * step, step)});
}

void AxisScale::set_logarithmic(const Axis& axis, const Extent& content, int ticks) {
  min_ = axis.min.value_or(content.min.value_or(1.0));
  max_ = axis.max.value_or(content.max.value_or(10.0));
  LUKOU_EXPECT(min_ > 0.0);
  if (!axis.min) min_ = std::pow(10.0, std::floor(std::log10(min_) + kSame));
  if (!axis.max) max_ = std::pow(10.0, std::ceil(std::log10(max_) - kSame));
  if (!(min_ < max_)) max_ = 10.0 * min_;
  const int first = static_cast<int>(std::floor(std::log10(min_) + kSame));
  const int last = static_cast<int>(std::ceil(std::log10(max_) - kSame));
  const bool fine = last - first <= ticks / 2;
  const int every = std::max(1, (last - first + ticks - 1) / ticks);
  for (int decade = first; decade <= last; decade += every) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double at = factor * std::pow(10.0, decade);
      if ((factor > 1.0 && !fine) || at < min_ * (1.0 - kSame) || at > max_ * (1.0 + kSame)) continue;
      ticks_.push_back({at, factor > 1.0 ? tick_text(at, std::pow(10.0, decade)) : decade_text(at)});
    }
  }
}

double AxisScale::share(double value) const {
  if (!logarithmic_) return (value - min_) / (max_ - min_);
  return std::log10(value / min_) / std::log10(max_ / min_);
}

}  // namespace lukou::figure
