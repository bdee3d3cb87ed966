#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "services/rsu/process/run_rsu.hpp"

namespace lukou::python {

/// Puts the SDK into the module.
void bind_sdk(pybind11::module_& m);
/// Keeps a Python algorithm alive for as long as C++ holds it. Requires Python's lock; throws what is no algorithm.
std::unique_ptr<RsuAlgorithm> kept(pybind11::object algorithm);

}  // namespace lukou::python
