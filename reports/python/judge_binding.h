// Binds the oracle's answer to a step; `check`, which compares a detector's steps with it; and the
// places of contacts.
#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

void bind_judge(pybind11::module_& module);
void bind_check(pybind11::module_& module);
void bind_contact_points(pybind11::module_& module);

}  // namespace assay::python
