#pragma once

#include "services/lukou/launch/run_request.hpp"

namespace lukou::report {

/// "1:02:03" or "2:03"
std::string duration_text(double seconds);

/// Shows how a run or a sweep goes on, on standard error: a bar that redraws itself on a terminal (unless NO_COLOR is
/// set), a line every tenth of it elsewhere.
class Progress {
 public:
  Progress();
  void show(const launch::RunNews& news);
  /// `share` of it is done; `figures` stand behind the bar.
  void show(const std::string& name, double share, const std::string& figures, const std::string& phase = "running");
  /// Leaves the terminal on a fresh line.
  void finish();

 private:
  bool terminal_;
  bool drawn_ = false;
  long long tenths_ = -1;
  std::string phase_;
};

}  // namespace lukou::report
