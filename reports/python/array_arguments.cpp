#include "reports/python/array_arguments.h"

namespace assay::python {

namespace py = pybind11;

namespace {

// Whether the numbers stand in the byte order of the machine, and at addresses where the processor
// expects them.
template <class Scalar>
bool holds(const py::array& array) {
  return py::isinstance<py::array_t<Scalar>>(array) &&
         (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

// Whether the rows stand one behind the other, at distances of whole numbers. If there is a single
// row, its stride says nothing.
template <class Scalar>
bool is_viewable(const py::array& array) {
  constexpr py::ssize_t size = sizeof(Scalar), columns = 3;
  if (!holds<Scalar>(array) || array.ndim() != 2 || array.shape(1) != columns) return false;
  if (array.shape(0) == 0) return true;  // whatever strides it states
  if (array.strides(1) != size) return false;
  return array.shape(0) <= 1 ||
         (array.strides(0) >= columns * size && array.strides(0) % size == 0);
}

// Calls a function of assay/arrays.py.
template <class... Arguments>
py::array converted(const char* function, const Arguments&... arguments) {
  return py::module_::import("assay.arrays")
      .attr(function)(arguments...)
      .template cast<py::array>();
}

template <class Scalar>
constexpr const char* conversion = "positions";
template <>
constexpr const char* conversion<std::int32_t> = "triangles";

// A subclass may mean something else by its elements. Masked arrays, for example, are treated in
// Python.
bool is_plain(const py::object& given) {
  return Py_TYPE(given.ptr()) ==
         reinterpret_cast<PyTypeObject*>(py::detail::npy_api::get().PyArray_Type_);
}

}  // namespace

template <class Scalar>
RowsArgument<Scalar>::RowsArgument(const py::object& given, const char* name) {
  if (is_plain(given)) {
    array_ = py::reinterpret_borrow<py::array>(given);
    if (is_viewable<Scalar>(array_)) return;
  }
  array_ = converted(conversion<Scalar>, given, name);
  if (!is_viewable<Scalar>(array_)) throw py::type_error("assay.arrays gave no rows of three");
}

template <class Scalar>
typename RowsArgument<Scalar>::View RowsArgument<Scalar>::view() const {
  constexpr Eigen::Index columns = 3;
  const Eigen::Index rows = array_.shape(0);
  const Eigen::Index stride =
      rows > 1 ? array_.strides(0) / static_cast<Eigen::Index>(sizeof(Scalar)) : columns;
  return View(static_cast<const Scalar*>(array_.data()), rows, columns,
              Eigen::OuterStride<>(stride));
}

template class RowsArgument<double>;
template class RowsArgument<std::int32_t>;

QueriesArgument::QueriesArgument(const py::object& given, const char* name)
    : array_(converted("queries", given, name)) {
  const bool fits = holds<double>(array_) && array_.ndim() == 3 && array_.shape(1) == points &&
                    array_.shape(2) == axes &&
                    (array_.flags() & py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_) != 0;
  if (!fits) throw py::type_error("assay.arrays gave no queries");
}

detector::Point QueriesArgument::point(std::size_t query, std::size_t corner) const {
  const double* at = static_cast<const double*>(array_.data()) + axes * (points * query + corner);
  return {at[0], at[1], at[2]};
}

}  // namespace assay::python
