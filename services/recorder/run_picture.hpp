#pragma once

#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/expected.hpp"
#include "common/intersection/signal_promise.hpp"
#include "common/lockstep/messages.hpp"
#include "common/measures/reception_measures.hpp"
#include "common/measures/run_measures.hpp"
#include "common/measures/uplink_watch.hpp"
#include "services/recorder/view_columns.hpp"

namespace lukou {

/// A run as it stands at its newest step: the running figures, the cars, the heads, the radio. What observers see of a
/// run that goes on, and of one that is replayed.
class RunPicture {
 public:
  explicit RunPicture(const MeasureParameters& parameters) : measures_(parameters) {}

  /// Takes the next step; `signal` is the controller's batch that came in force with it, null if none did. Errors: a
  /// gap in the promise, columns that do not fit together.
  Expected<Done> add(const TrafficBatch& traffic, const SignalBatch* signal);
  /// Keeps the cars of the step just added; the batch's storage is swapped for a used one.
  void keep(TrafficBatch& traffic) { std::swap(newest_, traffic); }
  /// What observers see. Requires a step that has been kept.
  void fill(View& view) const;

  [[nodiscard]] const RunMeasures& measures() const { return measures_; }
  /// The radio in the last full second: new with every tenth step.
  [[nodiscard]] const std::vector<ReceptionFigures>& last_second() const { return last_second_; }
  /// The same for the second that the end of the run cuts short.
  const std::vector<ReceptionFigures>& cut_second();
  [[nodiscard]] bool radio_modelled() const { return reception_.any(); }

 private:
  RunMeasures measures_;
  UplinkWatch uplink_;
  ReceptionMeasures reception_;
  std::vector<ReceptionFigures> last_second_;
  SignalPromise promise_;
  HeadForecast heads_;
  TrafficBatch newest_;
};

}  // namespace lukou
