#include "services/rsu/python/helpers.hpp"

#include <pybind11/stl.h>

#include "services/rsu/sdk/arrival.hpp"
#include "services/rsu/sdk/planning.hpp"

namespace lukou::python {
namespace {

namespace py = pybind11;

/// Python callers get an exception where C++ callers would break a contract.
void require_positive(double value, const char* what) {
  if (!(value > 0.0)) throw py::value_error(std::string(what) + " must be above 0");
}

/// The speed to change to at a rate, then hold.
void bind_cruise(py::module_& m, const char* name, std::optional<double> (*cruise_mps)(const ArrivalGoal&, double),
                 const char* rate) {
  m.def(
      name,
      [cruise_mps, rate](double distance_m, double speed_mps, double time_s, double rate_mps2) {
        require_positive(time_s, "time_s");
        require_positive(rate_mps2, rate);
        return cruise_mps({distance_m, speed_mps, time_s}, rate_mps2);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("time_s"), py::arg(rate));
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
        const ArrivalGoal goal{distance_m, speed_mps, time_s};
        const auto ramp = end_speed_mps ? smoothest_arrival(goal, *end_speed_mps) : smoothest_arrival(goal);
        return std::pair(ramp.start_mps2, ramp.slope_mps3);
      },
      py::arg("distance_m"), py::arg("speed_mps"), py::arg("time_s"), py::arg("end_speed_mps") = std::nullopt);
  bind_cruise(m, "cruise_after_braking_mps", &cruise_after_braking_mps, "braking_mps2");
  bind_cruise(m, "cruise_after_speeding_up_mps", &cruise_after_speeding_up_mps, "acceleration_mps2");
}

}  // namespace lukou::python
