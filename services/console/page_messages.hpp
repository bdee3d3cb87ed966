#pragma once

#include <deque>
#include <optional>

#include "common/lockstep/messages.hpp"

// What the bus says, in the words of the page.

namespace lukou::console {

class Picture;
class RunStatus;
class Statistics;

/// Without the signal program. Requires a well-formed view.
Picture picture_of(const View& view);
/// Without the pace. Requires a well-formed view.
Statistics statistics_of(const View& view);

/// Simulated seconds per second of wall time, over the last second; at slow paces over the last ten steps or five
/// seconds.
class PaceMeter {
 public:
  void note(double now_s, Step step);
  [[nodiscard]] double pace() const;

 private:
  struct Seen {
    double at_s = 0.0;
    Step step = 0;
  };
  std::deque<Seen> seen_;
};

/// Who of the run's processes is alive. `rsus_heard`: per RSU the epoch that the engine hears, 0 = silent; empty: not
/// known. `clock_silent_s`: wall time since the clock last spoke.
RunStatus status_of(const RunState& state, std::uint32_t rsus, const std::vector<std::uint32_t>& rsus_heard,
                    double clock_silent_s);

}  // namespace lukou::console
