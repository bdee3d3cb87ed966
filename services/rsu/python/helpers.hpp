#pragma once

#include <pybind11/pybind11.h>

namespace lukou::python {

/// The SDK's free functions.
void bind_helpers(pybind11::module_& m);

}  // namespace lukou::python
