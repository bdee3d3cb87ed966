#include "services/lukou/report/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lukou::report {
namespace {

/// "1234.5 of 7200 s, 812x, 83 cars, 0:07 left"
std::string figures(const launch::RunNews& news) {
  const double simulated_s = static_cast<double>(news.step) / 10.0;
  const double factor = news.wall_s > 0.0 ? simulated_s / news.wall_s : 0.0;
  char text[160];
  std::snprintf(text, sizeof text, "%.1f of %.1f s, %.3gx", simulated_s, static_cast<double>(news.end) / 10.0, factor);
  std::string line = text;
  if (news.pace > 0.0) {
    std::snprintf(text, sizeof text, " (asked %gx)", news.pace);
    line += text;
  }
  if (news.cars_in_system >= 0) line += ", " + std::to_string(news.cars_in_system) + " cars";
  if (news.step > 0 && news.phase == "running") {
    const double per_step_s = news.wall_s / static_cast<double>(news.step);
    line += ", " + duration_text(per_step_s * static_cast<double>(news.end - news.step)) + " left";
  }
  return line;
}

}  // namespace

std::string duration_text(double seconds) {
  const long long whole = std::llround(seconds);
  char text[32];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  }
  return text;
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr) {}

void Progress::show(const launch::RunNews& news) {
  const double share = news.end > 0 ? static_cast<double>(news.step) / static_cast<double>(news.end) : 0.0;
  show(news.run, share, figures(news), news.phase);
}

void Progress::show(const std::string& name, double share, const std::string& figures, const std::string& phase) {
  if (terminal_) {
    constexpr int kWidth = 24;
    const int filled = static_cast<int>(share * kWidth);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kWidth - filled), '.');
    std::fprintf(stderr, "\r\033[K%s [%s] %s%s", name.c_str(), bar.c_str(), figures.c_str(),
                 phase == "running" ? "" : (", " + phase).c_str());
    drawn_ = true;
    return;
  }
  const auto tenths = static_cast<long long>(share * 10.0);
  if (tenths == tenths_ && phase == phase_) return;
  const bool news_worth = tenths != tenths_ || phase != "running";
  tenths_ = tenths;
  phase_ = phase;
  if (news_worth) std::fprintf(stderr, "%s: %s, %s\n", name.c_str(), phase.c_str(), figures.c_str());
}

void Progress::finish() {
  if (drawn_) std::fputc('\n', stderr);
}

}  // namespace lukou::report
