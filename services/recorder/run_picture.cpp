#include "services/recorder/run_picture.hpp"

#include <string>

namespace lukou {
namespace {

bool radio_is_whole(const TrafficBatch& traffic) {
  return traffic.reception.well_formed() && traffic.uplink.well_formed() &&
         traffic.uplink_vehicle.size() == traffic.uplink.size() && traffic.uplink_rsu.size() == traffic.uplink.size();
}

}  // namespace

Expected<Done> RunPicture::add(const TrafficBatch& traffic, const SignalBatch* signal) {
  if (signal != nullptr) {
    if (!promise_.extend(signal->first, signal->heads)) {
      return Error{"topic lukou/signal", "the batch of step " + std::to_string(signal->step) + " leaves a gap"};
    }
    heads_.take(*signal);
  }
  promise_.forget_before(traffic.step);
  if (!radio_is_whole(traffic)) {
    return Error{"topic lukou/traffic", "the reception report of step " + std::to_string(traffic.step) + " is broken"};
  }
  measures_.add(traffic);
  uplink_.add(traffic);
  reception_.add(traffic.reception);
  if (traffic.step > 0 && traffic.step % kStepsPerSecond == 0) last_second_ = reception_.take();
  return Done{};
}

const std::vector<ReceptionFigures>& RunPicture::cut_second() {
  last_second_ = reception_.take();
  return last_second_;
}

void RunPicture::fill(View& view) const {
  view.step = newest_.step;
  fill_cars(view, newest_, measures_, uplink_);
  fill_figures(view, measures_);
  fill_radio(view, last_second_);
  heads_.fill(view, promise_);
}

}  // namespace lukou
