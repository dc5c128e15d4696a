// Files of frames, by the project's own readers.
#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

void bind_frames(pybind11::module_& module);

}  // namespace assay::python
