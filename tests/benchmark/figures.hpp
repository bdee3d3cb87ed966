#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <string>
#include <vector>

namespace lukou::test {

/// A closed interval.
struct Band {
  double low;
  double high;
};

/// [value (1 - share), value (1 + share)].
Band within(double value, double share);

/// Prints measured values beside their bands and remembers whether one lay outside.
class BandTable {
 public:
  void row(const std::string& what, double value, Band band);
  [[nodiscard]] bool all_inside() const { return all_inside_; }

 private:
  bool all_inside_ = true;
};

/// A mean with the half width of its 95 % confidence interval (Student; infinite for a single value).
struct Estimate {
  double mean = 0.0;
  double half_width = 0.0;
};
/// Of at least one value.
Estimate estimate(const std::vector<double>& values);

/// Prints mean and half width as a cell of a table; `format` takes both.
void print_cell(const std::vector<double>& values, const char* format);

/// Middle value, or the mean of the two in the middle, and the extremes; of at least one value.
struct Spread {
  double median = 0.0;
  double least = 0.0;
  double most = 0.0;
};
Spread spread(std::vector<double> values);

/// Value of `--name N` among the arguments of main(), or `otherwise`. Exits with code 2 if N is missing or no number.
double number_argument(int argc, char** argv, const std::string& name, double otherwise);
/// Value of `--seeds N`, or `otherwise`. Exits with code 2 if it is below 1.
int seeds_argument(int argc, char** argv, int otherwise = 10);
/// True if `--name` is among the arguments.
bool flag_argument(int argc, char** argv, const std::string& name);

/// Results of run(0) ... run(count - 1), two at a time.
template <class Result>
std::vector<Result> two_at_a_time(int count, const std::function<Result(int)>& run) {
  std::vector<Result> results;
  for (int i = 0; i < count; i += 2) {
    std::future<Result> second;
    if (i + 1 < count) second = std::async(std::launch::async, run, i + 1);
    results.push_back(run(i));
    if (second.valid()) results.push_back(second.get());
  }
  return results;
}

}  // namespace lukou::test
