#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/launch/run_request.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/rsu/python/sdk_binding.hpp"

// The module `lukou`: the SDK, and whole runs inside the Python process for studies. lukou.pyi describes both.

namespace py = pybind11;

namespace lukou::python {
namespace {

/// What became of a run.
struct RunResult {
  std::string folder;
  std::string ended;
  int exit_code = 0;
  py::object summary;
};

MakeAlgorithm maker(py::object make) {
  return [make = std::make_shared<py::object>(std::move(make))](const RsuSetup& setup) {
    const py::gil_scoped_acquire locked;
    return kept((*make)(setup));
  };
}

/// A class or a function for every RSU, a dict for single ones, None for the scenario's own algorithms.
std::map<std::uint32_t, MakeAlgorithm> makers(const py::object& algorithm, std::uint32_t rsus) {
  std::map<std::uint32_t, MakeAlgorithm> made;
  if (algorithm.is_none()) return made;
  if (!py::isinstance<py::dict>(algorithm)) {
    for (std::uint32_t rsu = 0; rsu < rsus; ++rsu) made[rsu] = maker(algorithm);
    return made;
  }
  for (const auto& [rsu, make] : py::cast<std::map<std::uint32_t, py::object>>(algorithm)) made[rsu] = maker(make);
  return made;
}

/// Of single RSUs: they are added if the scenario does not have them, as `lukou run --rsu N=...` does.
std::vector<std::uint32_t> single_rsus(const py::object& algorithm) {
  std::vector<std::uint32_t> rsus;
  if (!py::isinstance<py::dict>(algorithm)) return rsus;
  for (const auto& [rsu, make] : py::cast<std::map<std::uint32_t, py::object>>(algorithm)) rsus.push_back(rsu);
  return rsus;
}

/// A shipped scenario, which lies where this module does: the program that runs is Python's own.
std::string with_shipped(const std::string& name) {
  namespace fs = std::filesystem;
  const auto known = scenario::shipped_names();
  if (fs::exists(name) || std::ranges::find(known, name) != known.end()) return name;
  const auto module = py::cast<std::string>(py::module_::import("lukou").attr("__file__"));
  const fs::path folder = fs::path(module).parent_path();
  for (const fs::path& shipped :
       {folder / "../../launch_scripts/scenarios", folder / "../../../share/lukou/scenarios"}) {
    const fs::path file = shipped / (name + ".textproto");
    if (fs::exists(file)) return file.lexically_normal().string();
  }
  return name;
}

py::object parsed(const std::filesystem::path& json) {
  std::ifstream file(json, std::ios::binary);
  if (!file) return py::none();
  std::stringstream text;
  text << file.rdbuf();
  return py::module_::import("json").attr("loads")(text.str());
}

RunResult run(const std::string& scenario_name, const py::object& algorithm, const std::vector<std::string>& sets,
              std::optional<std::uint64_t> seed, const py::object& duration_s, const std::string& out) {
  const ScenarioArguments arguments{.scenario = with_shipped(scenario_name),
                                    .sets = sets,
                                    .duration = duration_s.is_none() ? "" : py::cast<std::string>(py::str(duration_s)),
                                    .seed = seed ? std::to_string(*seed) : "",
                                    .rsu_algorithms = {},
                                    .rsu_times = {},
                                    .rsus_of_a_user = single_rsus(algorithm)};
  auto scenario = load(arguments);
  if (!scenario) throw py::value_error(scenario.error().text());
  const std::uint32_t rsus = scenario::protocol(scenario.value()).rsus;
  launch::RunRequest request{.scenario = std::move(scenario).value(),
                             .name = std::filesystem::path(scenario_name).stem().string(),
                             .run_id = {},
                             .in_process = true,
                             .out = out,
                             .rsu = {},
                             .make_rsu = makers(algorithm, rsus)};
  launch::RunReport report;
  {
    const py::gil_scoped_release free;
    report = launch::run_in_process(request, {});
  }
  return {report.folder.string(), report.ended, report.exit_code, parsed(report.folder / "summary.json")};
}

}  // namespace
}  // namespace lukou::python

PYBIND11_MODULE(lukou, m) {
  using namespace lukou::python;
  m.doc() =
      "A roadside unit (RSU) for Lukou in Python: inherit from RsuAlgorithm, give the class to run_rsu(), or to run() "
      "for a whole run in this process.";
  bind_sdk(m);
  py::class_<RunResult>(m, "RunResult")
      .def_readonly("folder", &RunResult::folder)
      .def_readonly("ended", &RunResult::ended)
      .def_readonly("exit_code", &RunResult::exit_code)
      .def_readonly("summary", &RunResult::summary);
  m.def("run", &run, py::arg("scenario"), py::arg("algorithm") = py::none(), py::kw_only(),
        py::arg("set") = std::vector<std::string>{}, py::arg("seed") = py::none(), py::arg("duration") = py::none(),
        py::arg("out") = "");
}
