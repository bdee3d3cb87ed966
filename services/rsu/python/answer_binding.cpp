#include "services/rsu/python/answer_binding.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "common/intersection/conflicts.hpp"
#include "services/rsu/sdk/rsu_answer.hpp"

namespace py = pybind11;

namespace lukou::python {
namespace {

void advise(RsuAnswer& answer, std::uint64_t car, double acceleration_mps2, double lifetime_s, Binding binding) {
  answer.advise(static_cast<TemporaryId>(car),
                {.acceleration_mps2 = acceleration_mps2, .lifetime = step_at_or_after(lifetime_s), .binding = binding});
}

void advise_all(RsuAnswer& answer, const py::array_t<std::uint64_t, py::array::forcecast>& cars,
                const py::array_t<double, py::array::forcecast>& accelerations_mps2, double lifetime_s,
                Binding binding) {
  if (cars.ndim() != 1 || accelerations_mps2.ndim() != 1 || cars.shape(0) != accelerations_mps2.shape(0)) {
    throw std::invalid_argument("advise_all: takes two one-dimensional arrays of equal length");
  }
  for (py::ssize_t i = 0; i < cars.shape(0); ++i) {
    advise(answer, cars.at(i), accelerations_mps2.at(i), lifetime_s, binding);
  }
}

LaneSet lanes_named(const std::vector<std::string>& names) {
  LaneSet lanes;
  for (const std::string& lane_name : names) lanes.insert(lane_called(lane_name));
  return lanes;
}

void request_green(RsuAnswer& answer, const std::vector<std::string>& lanes, double lifetime_s) {
  answer.request_green(lanes_named(lanes), step_at_or_after(lifetime_s));
}

/// As in a test or a user's algorithm: (seconds, m/s2) one after the other.
using Segments = std::vector<std::pair<double, double>>;

void advise_profile(RsuAnswer& answer, std::uint64_t car, const Segments& segments, Binding binding) {
  AccelerationProfile profile{.segments = {}, .binding = binding};
  for (const auto& [duration_s, acceleration_mps2] : segments) {
    profile.segments.push_back({step_at_or_after(duration_s), acceleration_mps2});
  }
  answer.advise_profile(static_cast<TemporaryId>(car), std::move(profile));
}

void advise_speed(RsuAnswer& answer, std::uint64_t car, double speed_mps, double lifetime_s, Binding binding) {
  answer.advise_speed(static_cast<TemporaryId>(car),
                      {.speed_mps = speed_mps, .lifetime = step_at_or_after(lifetime_s), .binding = binding});
}

void lane_speed(RsuAnswer& answer, const std::string& lane_name, double speed_mps, double lifetime_s) {
  answer.lane_speed(lane_called(lane_name), speed_mps, step_at_or_after(lifetime_s));
}

std::optional<Segments> segments_of(const RsuAnswer::Item& item) {
  if (!item.profile) return std::nullopt;
  Segments segments;
  for (const AccelerationSegment& segment : item.profile->segments) {
    segments.emplace_back(time_s(segment.duration), segment.acceleration_mps2);
  }
  return segments;
}

std::optional<double> lifetime_of(const RsuAnswer::Item& item) {
  if (item.advice) return time_s(item.advice->lifetime);
  if (item.speed) return time_s(item.speed->lifetime);
  if (!item.profile) return std::nullopt;
  Step life = 0;
  for (const AccelerationSegment& segment : item.profile->segments) life += segment.duration;
  return time_s(life);
}

std::optional<Binding> binding_of(const RsuAnswer::Item& item) {
  if (item.advice) return item.advice->binding;
  if (item.speed) return item.speed->binding;
  return item.profile ? std::optional(item.profile->binding) : std::nullopt;
}

}  // namespace

Lane lane_called(const std::string& lane_name) {
  const auto lane = lane_named(lane_name);
  if (!lane) throw std::invalid_argument("there is no lane `" + lane_name + "`: WL WC WR SL SC SR EL EC ER NL NC NR");
  return *lane;
}

std::vector<std::string> names_of(LaneSet lanes) {
  std::vector<std::string> names;
  for (const Lane lane : lanes) names.emplace_back(name(lane));
  return names;
}

void bind_answer(py::module_& m) {
  py::class_<RsuAnswer::Item>(m, "Advice")
      .def_property_readonly("car", [](const RsuAnswer::Item& item) { return static_cast<std::uint64_t>(item.car); })
      .def_property_readonly("release", &RsuAnswer::Item::is_release)
      .def_property_readonly("acceleration_mps2",
                             [](const RsuAnswer::Item& item) {
                               return item.advice ? std::optional(item.advice->acceleration_mps2) : std::nullopt;
                             })
      .def_property_readonly("segments", &segments_of)
      .def_property_readonly(
          "speed_mps",
          [](const RsuAnswer::Item& item) { return item.speed ? std::optional(item.speed->speed_mps) : std::nullopt; })
      .def_property_readonly("lifetime_s", &lifetime_of)
      .def_property_readonly("binding", &binding_of);
  py::class_<RsuAnswer>(m, "RsuAnswer")
      .def("advise", &advise, py::arg("car"), py::arg("acceleration_mps2"), py::arg("lifetime_s") = 0.5,
           py::arg("binding") = Binding::kGuard)
      .def("advise_all", &advise_all, py::arg("cars"), py::arg("accelerations_mps2"), py::arg("lifetime_s") = 0.5,
           py::arg("binding") = Binding::kGuard)
      .def("advise_profile", &advise_profile, py::arg("car"), py::arg("segments"), py::arg("binding") = Binding::kGuard)
      .def("advise_speed", &advise_speed, py::arg("car"), py::arg("speed_mps"), py::arg("lifetime_s") = 0.5,
           py::arg("binding") = Binding::kGuard)
      .def("lane_speed", &lane_speed, py::arg("lane"), py::arg("speed_mps"), py::arg("lifetime_s") = 0.5)
      .def("release", [](RsuAnswer& answer, std::uint64_t car) { answer.release(static_cast<TemporaryId>(car)); })
      .def("request_green", &request_green, py::arg("lanes"), py::arg("lifetime_s"));
  py::class_<SignalRequest>(m, "SignalRequest")
      .def_property_readonly("lanes", [](const SignalRequest& request) { return names_of(request.green); })
      .def_property_readonly("lifetime_s", [](const SignalRequest& request) { return time_s(request.lifetime); });
  m.def(
      "has_hard_conflict", [](const std::vector<std::string>& lanes) { return has_hard_conflict(lanes_named(lanes)); },
      py::arg("lanes"));
}

}  // namespace lukou::python
