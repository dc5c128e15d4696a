// Ctrl-C during work that does not hold the interpreter.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

#include "detector/mesh/step_types.h"

namespace assay::python {

// Asks Python now and then whether a signal has come, such as that of ctrl-C; the clock says only
// how often, for asking waits for the interpreter. In threads other than the main one Python says
// no. REQUIRES that the interpreter was released, and that raise() is called with it.
class Interruption {
 public:
  detector::StopFunction stop_function() {
    return [this] { return check(); };
  }

  // Raises what the handler of the signal has raised: KeyboardInterrupt, of ctrl-C.
  void raise() const {
    if (has_come_) throw pybind11::error_already_set();
  }

 private:
  bool check() {
    constexpr std::chrono::milliseconds interval{50};
    const auto now = std::chrono::steady_clock::now();
    if (has_come_ || now - last_ < interval) return has_come_;
    const pybind11::gil_scoped_acquire interpreter;
    last_ = std::chrono::steady_clock::now();
    return has_come_ = PyErr_CheckSignals() != 0;
  }

  bool has_come_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace assay::python
