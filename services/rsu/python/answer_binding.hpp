#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "common/intersection/lane_set.hpp"

namespace lukou::python {

/// What an RSU answers: RsuAnswer, and the advice and the request that a test reads back.
void bind_answer(pybind11::module_& m);

/// Throws std::invalid_argument if there is no such lane.
Lane lane_called(const std::string& lane_name);
/// "WL" and so on.
std::vector<std::string> names_of(LaneSet lanes);

}  // namespace lukou::python
