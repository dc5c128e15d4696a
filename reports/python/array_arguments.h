// Takes arrays of NumPy as the views that the detector reads, without a copy if their layout
// allows a view.
//
// Positions can be viewed if they are float64 in rows of three adjacent numbers (the rows may be
// apart, as in a slice of a larger array), and triangles if they are int32 in such rows; read-only
// arrays too. Everything else is converted once by assay/arrays.py, or refused there with its
// dtype and shape.
#pragma once

#include <pybind11/numpy.h>

#include "detector/mesh/types.h"

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

}  // namespace assay::python
