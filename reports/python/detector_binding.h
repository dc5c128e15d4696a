// The detector and what it carries from step to step, as classes of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

void bind_detector(pybind11::module_& module);

}  // namespace assay::python
