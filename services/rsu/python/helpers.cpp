#include "services/rsu/python/helpers.hpp"

#include <pybind11/stl.h>

#include "services/rsu/sdk/arrival.hpp"
#include "services/rsu/sdk/planning.hpp"

namespace lukou::python {
namespace {

namespace py = pybind11;

std::pair<double, double> pair_of(const RampedAcceleration& ramp) { return {ramp.start_mps2, ramp.slope_mps3}; }

std::pair<double, double> smoothest_of(double distance_m, double speed_mps, double time_s,
                                       std::optional<double> end_speed_mps) {
  const ArrivalGoal goal{distance_m, speed_mps, time_s};
  return pair_of(end_speed_mps ? smoothest_arrival(goal, *end_speed_mps) : smoothest_arrival(goal));
}

/// Python callers get an exception where C++ callers would break a contract.
void require_positive(double value, const char* what) {
  if (!(value > 0.0)) throw py::value_error(std::string(what) + " must be above 0");
}

}  // namespace

void bind_helpers(py::module_& m) {
  m.def(
      "time_to_line_s",
      [](double distance_m, double speed_mps, double acceleration_mps2, double cruise_mps) {
        require_positive(acceleration_mps2, "acceleration_mps2");
        return time_to_line_s(distance_m, speed_mps, acceleration_mps2, cruise_mps);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("acceleration_mps2"), py::arg("cruise_mps"));
  m.def(
      "arrival_acceleration_mps2",
      [](double distance_m, double speed_mps, double time_s) {
        require_positive(time_s, "time_s");
        return arrival_acceleration_mps2(distance_m, speed_mps, time_s);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("time_s"));
  m.def("carriable_mps2", &carriable_mps2, py::arg("wanted_mps2"), py::arg("limit_mps2"));
  m.def(
      "smoothest_arrival",
      [](double distance_m, double speed_mps, double time_s, std::optional<double> end_speed_mps) {
        require_positive(time_s, "time_s");
        return smoothest_of(distance_m, speed_mps, time_s, end_speed_mps);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("time_s"), py::arg("end_speed_mps") = std::nullopt);
  m.def(
      "cruise_after_braking_mps",
      [](double distance_m, double speed_mps, double time_s, double braking_mps2) {
        require_positive(time_s, "time_s");
        require_positive(braking_mps2, "braking_mps2");
        return cruise_after_braking_mps({distance_m, speed_mps, time_s}, braking_mps2);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("time_s"), py::arg("braking_mps2"));
  m.def(
      "cruise_after_speeding_up_mps",
      [](double distance_m, double speed_mps, double time_s, double acceleration_mps2) {
        require_positive(time_s, "time_s");
        require_positive(acceleration_mps2, "acceleration_mps2");
        return cruise_after_speeding_up_mps({distance_m, speed_mps, time_s}, acceleration_mps2);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("time_s"), py::arg("acceleration_mps2"));
}

}  // namespace lukou::python
