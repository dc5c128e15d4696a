// Common parts of the modules for Python: problems of C++ code become exceptions, ctrl-C works
// while the interpreter is released, and NumPy arrays are input and results of the detector. Input
// is not copied if its layout allows a view.
//
// Positions can be viewed if they are float64 in rows of three adjacent numbers (the rows may be
// apart, as in a slice of a larger array), and triangles if they are int32 in such rows; read-only
// arrays too. assay/arrays.py converts other arrays once, or refuses them with a message that
// states dtype or shape.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"
#include "detector/step_result.h"

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

// Asks Python now and then whether a signal has arrived, such as that of ctrl-C. A clock decides
// how often it asks, because asking waits for the interpreter. Only the thread that made this
// object asks; other threads may take part in the work. REQUIRES that this thread holds the
// interpreter when it makes this object and when it calls raise(), and releases it in between.
class Interruption {
 public:
  detector::StopFunction stop_function() {
    return [this] { return check(); };
  }

  // Raises the exception of the signal's handler, which is KeyboardInterrupt for ctrl-C. Does
  // nothing if no signal has arrived.
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
    // The exception is moved into this object, so that calls of Python before the end of the work
    // do not see it.
    raised_ = std::make_unique<pybind11::error_already_set>();
    return has_come_ = true;
  }

  std::thread::id maker_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::unique_ptr<pybind11::error_already_set> raised_;
  std::atomic<bool> has_come_ = false;
};

// Returns the result of work(stop). Other threads of Python can run meanwhile. If ctrl-C was
// pressed meanwhile, raises its exception.
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

template <class Scalar>
class RowsArgument {
 public:
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using View = Eigen::Map<const Rows, Eigen::Unaligned, Eigen::OuterStride<>>;

  // Takes an argument of a call. Raises TypeError or ValueError, with the argument's name, if
  // `object` is not an array of rows of three numbers.
  RowsArgument(const pybind11::object& object, const char* name);

  // Returns a view that is valid as long as this object, which holds the array.
  View view() const;

 private:
  pybind11::array array_;
};

using PositionsArgument = RowsArgument<double>;
using TrianglesArgument = RowsArgument<std::int32_t>;

// k x 4 x 3 numbers, adjacent, all finite: k queries of four points each.
class QueriesArgument {
 public:
  static constexpr std::size_t points = 4, axes = 3;

  QueriesArgument(const pybind11::object& object, const char* name);

  std::size_t count() const { return static_cast<std::size_t>(array_.shape(0)); }
  detector::Point point(std::size_t query, std::size_t corner) const;

 private:
  pybind11::array array_;
};

// Returns a read-only array of the vector's elements. The array owns the elements.
template <class Number, class Element>
pybind11::array array_of(std::vector<Element> elements) {
  static_assert(sizeof(Number) == sizeof(Element));
  auto list = std::make_unique<std::vector<Element>>(std::move(elements));
  const auto* data = reinterpret_cast<const Number*>(list->data());
  const auto size = static_cast<pybind11::ssize_t>(list->size());
  const pybind11::capsule owner(
      list.release(), [](void* vector) { delete static_cast<std::vector<Element>*>(vector); });
  pybind11::array_t<Number> array(size, data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &=
      ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// Makes an array of the numbers of a matrix. The array owns the matrix.
template <class Matrix>
pybind11::array owning_array(Matrix matrix) {
  auto memory = std::make_unique<Matrix>(std::move(matrix));
  const auto* data = memory->data();
  const pybind11::ssize_t rows = memory->rows(), columns = memory->cols();
  const pybind11::capsule owner(memory.release(),
                                [](void* address) { delete static_cast<Matrix*>(address); });
  return pybind11::array_t<typename Matrix::Scalar>({rows, columns}, data, owner);
}

// Returns an answer as a dict, with the names of the fields of assay.StepResult: `answer`, `first`
// (None without a collision), `pairs` int32 k x 2, `times` float64 k x 2, and `features` int32 k x
// 6, which are the kind (FeatureKind) and the vertices of the feature pair that meets first.
pybind11::dict arrays_of(detector::Answer answer, const detector::TimeEnclosure& first,
                         const std::vector<detector::PairContact>& contacts);

// Returns all fields of a result. REQUIRES a result that is no error.
pybind11::dict arrays_of(detector::StepResult result);

}  // namespace assay::python
