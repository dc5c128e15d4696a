// What calls from Python have in common: problems of the other rooms as exceptions, and ctrl-C
// during work that does not hold the interpreter.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"

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

// Asks Python now and then whether a signal has come, such as that of ctrl-C. A clock decides how
// often it asks, because asking waits for the interpreter. Only the thread that made this object
// asks; others may help with the work. REQUIRES that the interpreter is held when this object is
// made and when raise() is called; it is released in between.
class Interruption {
 public:
  detector::StopFunction stop_function() {
    return [this] { return check(); };
  }

  // Raises what the handler of the signal has raised; for ctrl-C that is KeyboardInterrupt.
  void raise() const {
    if (raised_) throw pybind11::error_already_set(*raised_);
  }

 private:
  bool check() {
    constexpr std::chrono::milliseconds interval{50};
    if (has_come_ || std::this_thread::get_id() != maker_) return has_come_;
    if (std::chrono::steady_clock::now() - last_ < interval) return false;
    const pybind11::gil_scoped_acquire interpreter;
    last_ = std::chrono::steady_clock::now();
    if (PyErr_CheckSignals() == 0) return false;
    // It is kept here, because what is called until the work has ended must not find it.
    raised_ = std::make_unique<pybind11::error_already_set>();
    return has_come_ = true;
  }

  std::thread::id maker_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::unique_ptr<pybind11::error_already_set> raised_;
  std::atomic<bool> has_come_ = false;
};

// Returns work(stop), during which other threads of Python may run, or raises what ctrl-C raised
// meanwhile.
template <class Work>
auto interruptible(const Work& work) {
  Interruption interruption;
  auto result = [&] {
    const pybind11::gil_scoped_release others_may_run;
    return work(interruption.stop_function());
  }();
  interruption.raise();
  return result;
}

}  // namespace assay::python
