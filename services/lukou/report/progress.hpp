#pragma once

#include "services/lukou/launch/run_request.hpp"

namespace lukou::report {

/// Shows how a run goes on, on standard error: a bar that redraws itself on a terminal (unless NO_COLOR is set), a line
/// every tenth of the run elsewhere.
class Progress {
 public:
  Progress();
  void show(const launch::RunNews& news);
  /// Leaves the terminal on a fresh line.
  void finish();

 private:
  bool terminal_;
  bool drawn_ = false;
  long long tenths_ = -1;
  std::string phase_;
};

}  // namespace lukou::report
