#include "tests/benchmark/speed_table.hpp"

#include <cstdio>
#include <cstdlib>

namespace lukou::test {
namespace {

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string number(const std::optional<double>& value, int decimals) {
  return value ? number(*value, decimals) : std::string("");
}

bool reached(double value, const std::optional<double>& aim, bool less_is_better) {
  return !aim || (less_is_better ? value <= *aim : value >= *aim);
}

void print_names(const char* what, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::printf("%s:", what);
  const char* separator = " ";
  for (const std::string& name : names) {
    std::printf("%s%s", separator, name.c_str());
    separator = "; ";
  }
  std::printf("\n");
}

}  // namespace

SpeedTable::SpeedTable(int repeats) {
  std::printf("\n| what (median of %d) | measured | least - most | floor | goal | of the goal | |\n", repeats);
  std::printf("|---|---|---|---|---|---|---|\n");
}

void SpeedTable::row(const std::string& what, const Spread& measured, const Aim& aim, int decimals) {
  const bool floor_met = reached(measured.median, aim.floor, aim.less_is_better);
  const bool goal_met = reached(measured.median, aim.goal, aim.less_is_better);
  if (!floor_met) below_.push_back(what);
  if (!goal_met) short_of_goal_.push_back(what);
  std::string way;
  if (aim.goal && measured.median > 0.0)
    way = number(aim.less_is_better ? *aim.goal / measured.median : measured.median / *aim.goal, 2);
  const char* verdict = !floor_met ? "BELOW THE FLOOR" : !aim.goal ? "" : goal_met ? "goal" : "floor";
  std::printf("| %s | %s | %s - %s | %s | %s | %s | %s |\n", what.c_str(), number(measured.median, decimals).c_str(),
              number(measured.least, decimals).c_str(), number(measured.most, decimals).c_str(),
              number(aim.floor, decimals).c_str(), number(aim.goal, decimals).c_str(), way.c_str(), verdict);
  std::fflush(stdout);
}

void SpeedTable::gap(const std::string& what, const Aim& aim, const std::string& why, int decimals) {
  unmeasured_.push_back(what + " (" + why + ")");
  std::printf("| %s | not measured | | %s | %s | | |\n", what.c_str(), number(aim.floor, decimals).c_str(),
              number(aim.goal, decimals).c_str());
}

void SpeedTable::print_verdict() const {
  std::printf("\n");
  print_names("below the floor", below_);
  print_names("short of the goal", short_of_goal_);
  print_names("not measured", unmeasured_);
  if (below_.empty()) std::printf(unmeasured_.empty() ? "all floors met\n" : "all measured floors met\n");
}

Line fitted_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  return {.a = mean_y - xy / xx * mean_x, .b = xy / xx, .r2 = xy * xy / (xx * yy)};
}

}  // namespace lukou::test
