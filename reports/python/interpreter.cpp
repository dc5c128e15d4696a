#include "reports/python/interpreter.h"

#include <Python.h>
#include <dlfcn.h>
#include <pybind11/pybind11.h>

#include <cstdlib>
#include <stdexcept>

namespace assay::python {
namespace {

namespace py = pybind11;

// Modules such as those of NumPy take the symbols of the interpreter from the program. Here the
// interpreter is a library that was loaded for this plug-in alone, so it is loaded again, which
// shows its symbols to all.
void show_interpreter_to_modules() {
  Dl_info library = {};
  if (::dladdr(reinterpret_cast<const void*>(&Py_InitializeFromConfig), &library) == 0 ||
      !::dlopen(library.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD))
    throw std::runtime_error("the library of Python is not found");
}

void demand(PyStatus status, PyConfig& config) {
  if (!PyStatus_Exception(status)) return;
  const char* why = status.err_msg ? status.err_msg : "no reason given";
  PyConfig_Clear(&config);
  throw std::runtime_error(std::string("Python does not start: ").append(why));
}

void initialize() {
  // Libraries that multiply matrices in threads reserve much memory for each of them.
  for (const char* name : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) ::setenv(name, "1", 0);
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.parse_argv = 0;
  config.install_signal_handlers = 0;
  config.write_bytecode = 0;  // there is no place to write it to
  config.buffered_stdio = 0;  // text must come out in the step that printed it
  const char* executable = std::getenv("ASSAY_PYTHON");
  if (!executable || !*executable) executable = ASSAY_PYTHON_EXECUTABLE;
  demand(PyConfig_SetBytesString(&config, &config.program_name, executable), config);
  demand(Py_InitializeFromConfig(&config), config);
  PyConfig_Clear(&config);
}

}  // namespace

void start_interpreter(const char* package) {
  if (Py_IsInitialized()) return;
  show_interpreter_to_modules();
  initialize();
  {
    auto path = py::module_::import("sys").attr("path").cast<py::list>();
    path.insert(0, "");  // the current folder, as with `python -m`
    path.append(package);
  }
  PyEval_SaveThread();
}

}  // namespace assay::python
