#include "tests/benchmark/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace lukou::test {
namespace {

/// Two-sided 95 % quantiles of Student's t for 1 to 20 degrees of freedom (any table of the distribution).
constexpr std::array<double, 20> kStudent = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                             2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086};
constexpr double kNormal = 1.960;

}  // namespace

Band within(double value, double share) { return {value * (1.0 - share), value * (1.0 + share)}; }

void BandTable::row(const std::string& what, double value, Band band) {
  const bool inside = value >= band.low && value <= band.high;
  all_inside_ = all_inside_ && inside;
  std::printf("%-46s %10.3f   [%.3f, %.3f]  %s\n", what.c_str(), value, band.low, band.high, inside ? "ok" : "OUTSIDE");
  std::fflush(stdout);
}

Estimate estimate(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Estimate result;
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) {
    result.half_width = std::numeric_limits<double>::infinity();
    return result;
  }
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  const std::size_t freedom = values.size() - 1;
  const double quantile = freedom <= kStudent.size() ? kStudent[freedom - 1] : kNormal;
  result.half_width = quantile * std::sqrt(squares / static_cast<double>(freedom) / n);
  return result;
}

void print_cell(const std::vector<double>& values, const char* format) {
  const Estimate found = estimate(values);
  char text[64];
  std::snprintf(text, sizeof text, format, found.mean, found.half_width);
  std::printf(" %s |", text);
}

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const bool even = values.size() % 2 == 0;
  return {.median = even ? (values[middle - 1] + values[middle]) / 2.0 : values[middle],
          .least = values.front(),
          .most = values.back()};
}

double number_argument(int argc, char** argv, const std::string& name, double otherwise) {
  for (int i = 1; i < argc; ++i) {
    if ("--" + name != argv[i]) continue;
    char* end = nullptr;
    const double value = i + 1 < argc ? std::strtod(argv[i + 1], &end) : 0.0;
    if (end == nullptr || end == argv[i + 1] || *end != '\0') {
      std::fprintf(stderr, "--%s: needs a number\n", name.c_str());
      std::exit(2);
    }
    return value;
  }
  return otherwise;
}

int seeds_argument(int argc, char** argv, int otherwise) {
  const int seeds = static_cast<int>(number_argument(argc, argv, "seeds", otherwise));
  if (seeds >= 1) return seeds;
  std::fprintf(stderr, "--seeds: needs at least 1\n");
  std::exit(2);
}

bool flag_argument(int argc, char** argv, const std::string& name) {
  return std::any_of(argv + 1, argv + argc, [&](const char* argument) { return "--" + name == argument; });
}

}  // namespace lukou::test
