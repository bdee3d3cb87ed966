#pragma once

#include <optional>

#include "common/messages/rsc.hpp"
#include "services/rsu/model/heard_cars.hpp"
#include "services/rsu/sdk/rsu_answer.hpp"

namespace lukou {

/// The path that says an advice; empty for a release. `car` is what the RSU knows of the car: the path begins at its
/// last reported place and goes straight on, which a car of ours does not read. nullptr: not on the map; then it stands
/// at the centre of the junction. What no message can carry gives a path that does not fit.
std::optional<GuidedPath> guided_path(const RsuAnswer::Item& item, const CarReport* car);
Binding binding_of(const RsuAnswer::Item& item);

/// A lane's word; one for no lane of ours, or that no message can carry, does not fit.
LaneSpeed lane_word(const LaneSpeedAdvice& advice);

}  // namespace lukou
