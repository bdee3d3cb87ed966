#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lukou::figure {

/// What is told along one side of a figure.
struct Axis {
  std::string label;  ///< "latency"
  std::string unit;   ///< "ms"; stands behind the label in brackets
  bool logarithmic = false;
  std::optional<double> min;       ///< empty: from the content, widened to the next tick
  std::optional<double> max;       ///< the same
  std::vector<std::string> names;  ///< of the places 0, 1, 2, ... in place of numbers
};

/// "latency [ms]"
std::string title(const Axis& axis);

/// The smallest and the largest of some values; nothing as long as there are none.
struct Extent {
  std::optional<double> min;
  std::optional<double> max;

  /// Values that are not finite do not count.
  void take(double value);
};

struct Tick {
  double at = 0.0;
  std::string text;
};

/// Values of an axis as shares of its length.
class AxisScale {
 public:
  /// `ticks`: about how many there may be, at least 2.
  AxisScale(const Axis& axis, const Extent& content, int ticks);

  [[nodiscard]] double min() const { return min_; }
  [[nodiscard]] double max() const { return max_; }
  /// 0 at min, 1 at max; beyond them below 0 and above 1.
  [[nodiscard]] double share(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  void set_linear(const Axis& axis, const Extent& content, int ticks);
  void set_logarithmic(const Axis& axis, const Extent& content, int ticks);

  bool logarithmic_;
  double min_ = 0.0;
  double max_ = 1.0;
  std::vector<Tick> ticks_;
};

/// 1, 2, 2.5 or 5 times a power of ten: the least such step that is not below `step`. Requires step > 0.
double nice_step(double step);
/// A number with the decimals that multiples of `step` need: 2.5 in steps of 0.5 is "2.5", 2 in steps of 0.25 "2.00".
std::string tick_text(double value, double step);

}  // namespace lukou::figure
