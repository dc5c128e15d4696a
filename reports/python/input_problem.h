// Problems of the other rooms as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "detector/mesh/problem.h"

namespace assay::python {

// Raises assay.InputError, a ValueError, with its message and name ("index_out_of_range").
[[noreturn]] inline void raise_input_error(const char* name, const std::string& message) {
  const pybind11::object type = pybind11::module_::import("assay.errors").attr("InputError");
  PyErr_SetObject(type.ptr(), type(message, name).ptr());
  throw pybind11::error_already_set();
}

[[noreturn]] inline void raise(const detector::Problem& problem) {
  raise_input_error(detector::name_of(problem.error), problem.message);
}

}  // namespace assay::python
