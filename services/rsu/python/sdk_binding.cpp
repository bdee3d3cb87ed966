#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/rsu/process/run_rsu.hpp"
#include "services/rsu/python/helpers.hpp"
#include "services/rsu/python/lane_script.hpp"
#include "services/rsu/python/sdk_binding.hpp"
#include "services/rsu/sdk/planning.hpp"
#include "services/rsu/sdk/seen_cars.hpp"

// The SDK for Python: the same words as in C++ (services/rsu/sdk), described for people in lukou.pyi. The loop stays in
// C++; Python's lock is held during on_step alone.

namespace py = pybind11;

namespace lukou::python {
namespace {

/// A view is valid during on_step only; what Python keeps of it says so instead of reading what is gone.
struct Frame {
  const RsuView* view = nullptr;

  [[nodiscard]] const RsuView& get() const {
    if (view == nullptr) throw std::runtime_error("a view is valid during on_step only: copy what you keep");
    return *view;
  }
};
struct PyView {
  std::shared_ptr<Frame> frame;
};
struct PyLane {
  std::shared_ptr<Frame> frame;
  std::size_t index = 0;

  [[nodiscard]] const LaneView& get() const { return frame->get().lanes[index]; }
};

/// A column over the heard cars of all lanes, lane after lane, front to back.
template <class Value, class Of>
py::array_t<Value> column(const RsuView& view, Of of) {
  std::size_t cars = 0;
  for (const LaneView& lane : view.lanes) cars += lane.cars.size();
  py::array_t<Value> values(static_cast<py::ssize_t>(cars));
  Value* next = values.mutable_data();
  for (std::size_t i = 0; i < view.lanes.size(); ++i) {
    for (const HeardCar& car : view.lanes[i].cars) *next++ = of(i, car);
  }
  return values;
}

/// The heard cars as arrays of equal length.
struct CarTable {
  py::array_t<std::uint64_t> id;
  py::array_t<std::uint8_t> lane;
  py::array_t<double> distance_m, speed_mps, acceleration_mps2, age_s;

  explicit CarTable(const RsuView& view)
      : id(column<std::uint64_t>(view, [](auto, const HeardCar& car) { return static_cast<std::uint64_t>(car.id); })),
        lane(column<std::uint8_t>(view, [](auto i, const HeardCar&) { return static_cast<std::uint8_t>(i); })),
        distance_m(column<double>(view, [](auto, const HeardCar& car) { return car.distance_m; })),
        speed_mps(column<double>(view, [](auto, const HeardCar& car) { return car.speed_mps; })),
        acceleration_mps2(column<double>(view, [](auto, const HeardCar& car) { return car.acceleration_mps2; })),
        age_s(column<double>(view, [](auto, const HeardCar& car) { return time_s(car.age); })) {}
};

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
  for (const std::string& lane_name : names) {
    const auto lane = lane_named(lane_name);
    if (!lane) throw std::invalid_argument("there is no lane `" + lane_name + "`: WL WC WR SL SC SR EL EC ER NL NC NR");
    lanes.insert(*lane);
  }
  return lanes;
}

std::vector<std::string> names_of(LaneSet lanes) {
  std::vector<std::string> names;
  for (const Lane lane : lanes) names.emplace_back(name(lane));
  return names;
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
  const auto lane = lane_named(lane_name);
  if (!lane) throw std::invalid_argument("there is no lane `" + lane_name + "`: WL WC WR SL SC SR EL EC ER NL NC NR");
  answer.lane_speed(*lane, speed_mps, step_at_or_after(lifetime_s));
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

/// What a Python class inherits from.
class PyAlgorithm : public RsuAlgorithm {
 public:
  void on_step(const RsuView& heard, RsuAnswer& answer) override {
    const py::gil_scoped_acquire locked;
    const auto frame = std::make_shared<Frame>(Frame{&heard});
    const py::function method = py::get_override(static_cast<const RsuAlgorithm*>(this), "on_step");
    if (!method) throw std::runtime_error("the RSU has no method on_step(self, heard, answer)");
    struct Closer {
      Frame& frame;
      ~Closer() { frame.view = nullptr; }
    } const closer{*frame};
    method(PyView{frame}, py::cast(&answer, py::return_value_policy::reference));
  }
};

/// Keeps the Python object alive for as long as C++ holds its algorithm.
class Kept final : public RsuAlgorithm {
 public:
  explicit Kept(py::object object) : object_(std::move(object)), algorithm_(object_.cast<RsuAlgorithm*>()) {}
  ~Kept() override {
    const py::gil_scoped_acquire locked;
    object_ = py::object();
  }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  void on_step(const RsuView& heard, RsuAnswer& answer) override { algorithm_->on_step(heard, answer); }

 private:
  py::object object_;
  RsuAlgorithm* algorithm_;
};

/// An exception of the algorithm leaves as itself, so that Python prints its traceback.
int run(const py::function& make, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const py::gil_scoped_release free;
  return run_rsu_throwing(static_cast<int>(arguments.size()), argv.data(), [&](const RsuSetup& setup) {
    const py::gil_scoped_acquire locked;
    return kept(make(setup));
  });
}

RsuAnswer whole_answer(RsuAlgorithm& algorithm, const RsuSetup& setup, double now_s,
                       const std::map<std::string, LaneScript>& lanes, const std::optional<Actuation>& actuation) {
  ScriptedView scripted(setup.map, step_at_or_after(now_s), lanes, actuation);
  RsuAnswer answer;
  algorithm.on_step(scripted.view(), answer);
  return answer;
}

std::vector<RsuAnswer::Item> answer_of(RsuAlgorithm& algorithm, const RsuSetup& setup, double now_s,
                                       const std::map<std::string, LaneScript>& lanes,
                                       const std::optional<Actuation>& actuation) {
  return whole_answer(algorithm, setup, now_s, lanes, actuation).items();
}

std::optional<SignalRequest> request_of(RsuAlgorithm& algorithm, const RsuSetup& setup, double now_s,
                                        const std::map<std::string, LaneScript>& lanes,
                                        const std::optional<Actuation>& actuation) {
  return whole_answer(algorithm, setup, now_s, lanes, actuation).request();
}

}  // namespace

std::unique_ptr<RsuAlgorithm> kept(py::object algorithm) { return std::make_unique<Kept>(std::move(algorithm)); }

void bind_sdk(py::module_& m) {
  py::enum_<Binding>(m, "Binding").value("GUARD", Binding::kGuard).value("FOLLOWING", Binding::kFollowing);
  py::enum_<Aspect>(m, "Aspect")
      .value("RED", Aspect::kRed)
      .value("YELLOW", Aspect::kYellow)
      .value("GREEN", Aspect::kGreen);

  py::class_<MapView>(m, "MapView")
      .def_readonly("speed_limit_mps", &MapView::speed_limit_mps)
      .def_readonly("approach_length_m", &MapView::approach_length_m);
  py::class_<Actuation>(m, "Actuation")
      .def(py::init([](double min_green_s, double yellow_s, double all_red_s, double max_wait_s) {
             return Actuation{step_at_or_after(min_green_s), step_at_or_after(yellow_s), step_at_or_after(all_red_s),
                              step_at_or_after(max_wait_s)};
           }),
           py::kw_only(), py::arg("min_green_s") = 8.0, py::arg("yellow_s") = 3.0, py::arg("all_red_s") = 1.0,
           py::arg("max_wait_s") = 120.0)
      .def_property_readonly("min_green_s", [](const Actuation& rules) { return time_s(rules.min_green); })
      .def_property_readonly("yellow_s", [](const Actuation& rules) { return time_s(rules.yellow); })
      .def_property_readonly("all_red_s", [](const Actuation& rules) { return time_s(rules.all_red); })
      .def_property_readonly("max_wait_s", [](const Actuation& rules) { return time_s(rules.max_wait); });
  py::class_<RsuSetup>(m, "RsuSetup")
      .def(py::init(
               [](std::uint32_t index, double speed_limit_mps, double approach_length_m, double acceleration_max_mps2) {
                 return RsuSetup{index, {speed_limit_mps, approach_length_m}, acceleration_max_mps2};
               }),
           py::kw_only(), py::arg("index") = 0, py::arg("speed_limit_mps"), py::arg("approach_length_m"),
           py::arg("acceleration_max_mps2"))
      .def_readonly("index", &RsuSetup::index)
      .def_readonly("map", &RsuSetup::map)
      .def_readonly("acceleration_max_mps2", &RsuSetup::acceleration_max_mps2);
  py::class_<HeardCar>(m, "HeardCar")
      .def(py::init([](std::uint64_t id, double distance_m, double speed_mps, double acceleration_mps2, double age_s) {
             HeardCar car;
             car.id = static_cast<TemporaryId>(id);
             car.distance_m = distance_m;
             car.speed_mps = speed_mps;
             car.acceleration_mps2 = acceleration_mps2;
             car.age = step_at_or_after(age_s);
             return car;
           }),
           py::kw_only(), py::arg("id"), py::arg("distance_m"), py::arg("speed_mps"),
           py::arg("acceleration_mps2") = 0.0, py::arg("age_s") = 0.0)
      .def_property_readonly("id", [](const HeardCar& car) { return static_cast<std::uint64_t>(car.id); })
      .def_property_readonly("lane", [](const HeardCar& car) { return std::string(name(car.lane)); })
      .def_readonly("distance_m", &HeardCar::distance_m)
      .def_readonly("speed_mps", &HeardCar::speed_mps)
      .def_readonly("acceleration_mps2", &HeardCar::acceleration_mps2)
      .def_property_readonly("age_s", [](const HeardCar& car) { return time_s(car.age); })
      .def_readonly("accuracy_m", &HeardCar::accuracy_m);
  py::class_<SensedCar>(m, "SensedCar")
      .def(py::init([](std::uint32_t track, double distance_m, double speed_mps, double age_s, std::uint32_t sensor) {
             return SensedCar{.sensor = sensor,
                              .track = track,
                              .distance_m = distance_m,
                              .speed_mps = speed_mps,
                              .age = step_at_or_after(age_s)};
           }),
           py::kw_only(), py::arg("track"), py::arg("distance_m"), py::arg("speed_mps"), py::arg("age_s") = 0.0,
           py::arg("sensor") = 0)
      .def_readonly("sensor", &SensedCar::sensor)
      .def_readonly("track", &SensedCar::track)
      .def_property_readonly("lane", [](const SensedCar& car) { return std::string(name(car.lane)); })
      .def_readonly("distance_m", &SensedCar::distance_m)
      .def_readonly("speed_mps", &SensedCar::speed_mps)
      .def_property_readonly("age_s", [](const SensedCar& car) { return time_s(car.age); });
  py::class_<GreenWindow>(m, "GreenWindow")
      .def_readonly("begin_s", &GreenWindow::begin_s)
      .def_readonly("end_s", &GreenWindow::end_s);
  py::class_<QueueEstimate>(m, "QueueEstimate")
      .def_readonly("cars", &QueueEstimate::cars)
      .def_readonly("tail_m", &QueueEstimate::tail_m);
  py::class_<PyLane>(m, "LaneView")
      .def_property_readonly("name",
                             [](const PyLane& lane) { return std::string(name(static_cast<Lane>(lane.index))); })
      .def_property_readonly("cars",
                             [](const PyLane& lane) {
                               const auto cars = lane.get().cars;
                               return std::vector<HeardCar>(cars.begin(), cars.end());
                             })
      .def_property_readonly("sensed",
                             [](const PyLane& lane) {
                               const auto cars = lane.get().sensed;
                               return std::vector<SensedCar>(cars.begin(), cars.end());
                             })
      .def_property_readonly("last_crossing_s", [](const PyLane& lane) { return lane.get().last_crossing_s; })
      .def_property_readonly("aspect", [](const PyLane& lane) { return lane.get().aspect; })
      .def_property_readonly("aspect_since_s", [](const PyLane& lane) { return time_s(lane.get().aspect_since); })
      .def_property_readonly("changes",
                             [](const PyLane& lane) {
                               std::vector<std::pair<Aspect, double>> changes;
                               for (const SignalChange& change : lane.get().changes) {
                                 changes.emplace_back(change.aspect, time_s(change.step));
                               }
                               return changes;
                             })
      .def("green_windows", [](const PyLane& lane) { return green_windows(lane.get()); })
      .def(
          "green_at_or_after",
          [](const PyLane& lane, double at_s, double tail_s) { return green_at_or_after(lane.get(), at_s, tail_s); },
          py::arg("time_s"), py::arg("tail_s") = 0.0)
      .def("seen_cars",
           [](const PyLane& lane) {
             std::vector<SeenCar> cars;
             seen_cars(lane.get(), cars);
             return cars;
           })
      .def(
          "standing_queue",
          [](const PyLane& lane, double standing_mps) { return standing_queue(lane.get(), standing_mps); },
          py::arg("standing_mps") = 5.0 / 3.6);
  py::class_<SeenCar>(m, "SeenCar")
      .def_readonly("distance_m", &SeenCar::distance_m)
      .def_readonly("speed_mps", &SeenCar::speed_mps);
  py::class_<CarTable>(m, "CarTable")
      .def_readonly("id", &CarTable::id)
      .def_readonly("lane", &CarTable::lane)
      .def_readonly("distance_m", &CarTable::distance_m)
      .def_readonly("speed_mps", &CarTable::speed_mps)
      .def_readonly("acceleration_mps2", &CarTable::acceleration_mps2)
      .def_readonly("age_s", &CarTable::age_s);
  py::class_<PyView>(m, "RsuView")
      .def_property_readonly("step", [](const PyView& view) { return view.frame->get().step; })
      .def_property_readonly("time_s", [](const PyView& view) { return view.frame->get().time_s; })
      .def_property_readonly("map", [](const PyView& view) { return view.frame->get().map; })
      .def_property_readonly("actuation", [](const PyView& view) { return view.frame->get().actuation; })
      .def_property_readonly("promised_to_s", [](const PyView& view) { return time_s(view.frame->get().promised_to); })
      .def_property_readonly("request_acts_s",
                             [](const PyView& view) { return time_s(view.frame->get().request_acts); })
      .def("promised_green", [](const PyView& view) { return names_of(promised_green(view.frame->get())); })
      .def_property_readonly("cars", [](const PyView& view) { return CarTable(view.frame->get()); })
      .def_property_readonly("lanes", [](const PyView& view) {
        std::vector<PyLane> lanes;
        for (std::size_t i = 0; i < view.frame->get().lanes.size(); ++i) lanes.push_back({view.frame, i});
        return lanes;
      });

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
  py::class_<RsuAlgorithm, PyAlgorithm>(m, "RsuAlgorithm").def(py::init<>());

  bind_helpers(m);
  m.def(
      "has_hard_conflict", [](const std::vector<std::string>& lanes) { return has_hard_conflict(lanes_named(lanes)); },
      py::arg("lanes"));

  py::class_<LaneScript>(m, "LaneScript")
      .def(py::init([](std::vector<HeardCar> cars, std::vector<SensedCar> sensed, Aspect aspect, double aspect_since_s,
                       const std::vector<std::pair<Aspect, double>>& changes) {
             LaneScript script{std::move(cars), std::move(sensed), aspect, step_at_or_after(aspect_since_s), {}};
             for (const auto& [to, at_s] : changes) script.changes.push_back({to, step_at_or_after(at_s)});
             return script;
           }),
           py::kw_only(), py::arg("cars") = std::vector<HeardCar>{}, py::arg("sensed") = std::vector<SensedCar>{},
           py::arg("aspect") = Aspect::kRed, py::arg("aspect_since_s") = 0.0,
           py::arg("changes") = std::vector<std::pair<Aspect, double>>{});
  m.def("answer_of", &answer_of, py::arg("algorithm"), py::arg("setup"), py::kw_only(), py::arg("time_s") = 0.0,
        py::arg("lanes"), py::arg("actuation") = std::nullopt);
  m.def("request_of", &request_of, py::arg("algorithm"), py::arg("setup"), py::kw_only(), py::arg("time_s") = 0.0,
        py::arg("lanes"), py::arg("actuation") = std::nullopt);
  m.def(
      "run_rsu",
      [](const py::function& make) {
        return run(make, py::module_::import("sys").attr("argv").cast<std::vector<std::string>>());
      },
      py::arg("make"));
}

}  // namespace lukou::python
