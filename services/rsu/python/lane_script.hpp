#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/rsu/python/answer_binding.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou::python {

/// A lane as a test writes it.
struct LaneScript {
  std::vector<HeardCar> cars;
  std::vector<SensedCar> sensed;
  Aspect aspect = Aspect::kRed;
  Step aspect_since = 0;
  std::vector<SignalChange> changes;
};

/// Holds what a scripted view points to.
class ScriptedView {
 public:
  ScriptedView(const MapView& map, Step now, std::map<std::string, LaneScript> lanes,
               const std::optional<Actuation>& actuation)
      : lanes_(std::move(lanes)) {
    view_.actuation = actuation;
    view_.promised_to = now;
    view_.request_acts = now + 11;  // with the default promise
    view_.step = now;
    view_.time_s = time_s(now);
    view_.map = map;
    for (auto& [lane_name, script] : lanes_) {
      const Lane lane = lane_called(lane_name);
      for (HeardCar& car : script.cars) car.lane = lane;
      for (SensedCar& car : script.sensed) car.lane = lane;
      view_.lanes[index(lane)] = {.cars = script.cars,
                                  .sensed = script.sensed,
                                  .last_crossing_s = {},
                                  .aspect = script.aspect,
                                  .aspect_since = script.aspect_since,
                                  .changes = script.changes};
    }
  }
  [[nodiscard]] const RsuView& view() const { return view_; }

 private:
  std::map<std::string, LaneScript> lanes_;
  RsuView view_;
};

}  // namespace lukou::python
