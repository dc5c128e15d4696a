// The two elementary queries, many at once.
#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

void bind_queries(pybind11::module_& module);

}  // namespace assay::python
