#pragma once

#include <span>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/intersection/signal_promise.hpp"
#include "common/lockstep/messages.hpp"
#include "common/measures/reception_measures.hpp"
#include "common/measures/run_measures.hpp"
#include "common/measures/uplink_watch.hpp"

// What observers see, column by column. Nothing is computed here: the figures are those of the measures.

namespace lukou {

/// The cars of the newest step. Requires measures that have taken `traffic`.
void fill_cars(View& view, const TrafficBatch& traffic, const RunMeasures& measures, const UplinkWatch& uplink);
/// Running figures of all cars, the equipped ones and the others; queues.
void fill_figures(View& view, const RunMeasures& measures);
/// What the radio did in the last second.
void fill_radio(View& view, std::span<const ReceptionFigures> last_second);

/// When each head changes next: what the controller has promised, and beyond it what it forecasts.
class HeadForecast {
 public:
  void take(const SignalBatch& signal);
  /// The heads of view.step and their next change; none if the step is not promised.
  void fill(View& view, const SignalPromise& promise) const;

 private:
  std::vector<std::uint8_t> lane_;  ///< changes by lane, then by time
  std::vector<std::uint8_t> aspect_;
  std::vector<Step> at_;
};

}  // namespace lukou
