// The oracle's answer of a step; `check`, a detector's steps against it; where contacts are.
#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

void bind_judge(pybind11::module_& module);
void bind_check(pybind11::module_& module);
void bind_contact_points(pybind11::module_& module);

}  // namespace assay::python
