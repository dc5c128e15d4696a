// Arrays of NumPy: as the views that the detector reads, without a copy if their layout allows a
// view, and as its results.
//
// Positions can be viewed if they are float64 in rows of three adjacent numbers (the rows may be
// apart, as in a slice of a larger array), and triangles if they are int32 in such rows; read-only
// arrays too. Everything else is converted once by assay/arrays.py, or refused there with its
// dtype and shape.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <vector>

#include "detector/mesh/types.h"
#include "detector/step_result.h"

namespace assay::python {

template <class Scalar>
class RowsArgument {
 public:
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using View = Eigen::Map<const Rows, Eigen::Unaligned, Eigen::OuterStride<>>;

  // `name` is that of the argument, for errors. Raises TypeError and ValueError.
  RowsArgument(const pybind11::object& given, const char* name);

  // Valid as long as this object, which holds the array.
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

  QueriesArgument(const pybind11::object& given, const char* name);

  std::size_t count() const { return static_cast<std::size_t>(array_.shape(0)); }
  detector::Point point(std::size_t query, std::size_t corner) const;

 private:
  pybind11::array array_;
};

// An array of the vector's elements, which owns them and is not writeable.
template <class Number, class Element>
pybind11::array array_of(std::vector<Element> elements) {
  static_assert(sizeof(Number) == sizeof(Element));
  auto kept = std::make_unique<std::vector<Element>>(std::move(elements));
  const auto* data = reinterpret_cast<const Number*>(kept->data());
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const pybind11::capsule owner(
      kept.release(), [](void* vector) { delete static_cast<std::vector<Element>*>(vector); });
  pybind11::array_t<Number> array(size, data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &=
      ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// Makes an array of the numbers of a matrix. The array owns the matrix.
template <class Matrix>
pybind11::array owning_array(Matrix matrix) {
  auto kept = std::make_unique<Matrix>(std::move(matrix));
  const auto* data = kept->data();
  const pybind11::ssize_t rows = kept->rows(), columns = kept->cols();
  const pybind11::capsule owner(kept.release(),
                                [](void* gone) { delete static_cast<Matrix*>(gone); });
  return pybind11::array_t<typename Matrix::Scalar>({rows, columns}, data, owner);
}

// Answers by the names of the fields of assay.StepResult: `answer`, `first` (none without a
// collision), `pairs` int32 k x 2, `times` float64 k x 2, `features` int32 k x 6: the kind of the
// feature pair that has the first time (FeatureKind), and its vertices.
pybind11::dict arrays_of(detector::Answer answer, const detector::TimeEnclosure& first,
                         const std::vector<detector::PairContact>& contacts);

// All fields of a result. REQUIRES that it is no error.
pybind11::dict arrays_of(detector::StepResult result);

}  // namespace assay::python
