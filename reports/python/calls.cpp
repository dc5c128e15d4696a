#include "reports/python/calls.h"

#include "detector/parallel/workers.h"

namespace assay::python {

namespace py = pybind11;

namespace {

// Returns whether the numbers stand in the byte order of the machine, and at addresses where the
// processor expects them.
template <class Scalar>
bool holds(const py::array& array) {
  return py::isinstance<py::array_t<Scalar>>(array) &&
         (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

// Returns whether the rows stand one behind the other, at distances of whole numbers. If there is a
// single row, its stride says nothing.
template <class Scalar>
bool is_viewable(const py::array& array) {
  constexpr py::ssize_t size = sizeof(Scalar), columns = 3;
  if (!holds<Scalar>(array) || array.ndim() != 2 || array.shape(1) != columns) return false;
  if (array.shape(0) == 0) return true;  // without rows, strides do not matter
  if (array.strides(1) != size) return false;
  return array.shape(0) <= 1 ||
         (array.strides(0) >= columns * size && array.strides(0) % size == 0);
}

// Calls a function of assay/arrays.py.
template <class... Arguments>
py::array converted(const char* function, const Arguments&... arguments) {
  const detector::ProcessorState state;  // lets a denormal float32 become the same double
  return py::module_::import("assay.arrays")
      .attr(function)(arguments...)
      .template cast<py::array>();
}

template <class Scalar>
constexpr const char* conversion = std::is_integral_v<Scalar> ? "triangles" : "positions";

// Returns whether the object is a plain array. A subclass may mean something else by its elements;
// masked arrays, for example, are treated in Python.
bool is_plain(const py::object& object) {
  return Py_TYPE(object.ptr()) ==
         reinterpret_cast<PyTypeObject*>(py::detail::npy_api::get().PyArray_Type_);
}

py::dict dict_of(const detector::StepCounts& counts) {
  const auto& [search, marking, narrow, view, ghosts, release, closure_rounds, winding_numbers,
               free_components] = counts;
  using namespace py::literals;
  return py::dict(
      "search"_a = py::make_tuple(search.box_tests, search.child_counts, search.skipped,
                                  search.contour_tests, search.candidate_pairs),
      "marking"_a = py::make_tuple(marking.changed, marking.marked, marking.cleared),
      "narrow"_a = py::make_tuple(narrow.elementary_tests, narrow.rungs.axis, narrow.rungs.filter,
                                  narrow.rungs.fixed, narrow.rungs.unbounded, narrow.rungs.open),
      "view"_a = py::make_tuple(view.lanes, view.filter, view.exact, view.open),
      "ghosts"_a = py::make_tuple(ghosts.box_tests, ghosts.pairs, ghosts.elementary_tests,
                                  ghosts.near_triangles),
      "release"_a = py::make_tuple(release.in_doubt, release.released, release.pairs,
                                   release.elementary_tests, release.winding_numbers),
      "closure_rounds"_a = closure_rounds, "winding_numbers"_a = winding_numbers,
      "free_components"_a = free_components);
}

}  // namespace

template <class Scalar>
RowsArgument<Scalar>::RowsArgument(const py::object& object, const char* name) {
  if (is_plain(object)) {
    array_ = py::reinterpret_borrow<py::array>(object);
    if (is_viewable<Scalar>(array_)) return;
  }
  array_ = converted(conversion<Scalar>, object, name);
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

QueriesArgument::QueriesArgument(const py::object& object, const char* name)
    : array_(converted("queries", object, name)) {
  const bool fits = holds<double>(array_) && array_.ndim() == 3 && array_.shape(1) == points &&
                    array_.shape(2) == axes &&
                    (array_.flags() & py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_) != 0;
  if (!fits) throw py::type_error("assay.arrays gave no queries");
}

detector::Point QueriesArgument::point(std::size_t query, std::size_t corner) const {
  const double* at = static_cast<const double*>(array_.data()) + axes * (points * query + corner);
  return {at[0], at[1], at[2]};
}

py::dict arrays_of(detector::Answer answer, const detector::TimeEnclosure& first,
                   const std::vector<detector::PairContact>& contacts) {
  const auto count = static_cast<py::ssize_t>(contacts.size());
  constexpr py::ssize_t of_a_feature = 6;
  py::array_t<std::int32_t> pairs({count, py::ssize_t{2}}), features({count, of_a_feature});
  py::array_t<double> times({count, py::ssize_t{2}});
  std::int32_t *pair = pairs.mutable_data(), *feature = features.mutable_data();
  double* time = times.mutable_data();
  for (const auto& contact : contacts) {
    *pair++ = contact.pair.a;
    *pair++ = contact.pair.b;
    *time++ = contact.time.lo;
    *time++ = contact.time.hi;
    *feature++ = static_cast<std::int32_t>(contact.feature.kind);
    for (const auto vertex : contact.feature.vertices) *feature++ = vertex;
  }
  py::dict fields;
  fields["pairs"] = std::move(pairs);
  fields["times"] = std::move(times);
  fields["features"] = std::move(features);
  fields["answer"] = name_of(answer);
  fields["first"] = answer == detector::Answer::collision
                        ? py::object(py::make_tuple(first.lo, first.hi))
                        : py::none();
  return fields;
}

py::dict arrays_of(detector::StepResult result) {
  py::dict fields = arrays_of(result.answer, result.first, result.pairs);
  fields["view_positive"] = result.view_positive;
  fields["view_negative"] = result.view_negative;
  fields["view_zero"] = result.view_zero;
  fields["against_all"] = result.against_all;
  fields["violated"] = result.violated;
  fields["dirty"] = result.dirty;
  fields["views"] = name_of(result.views);
  fields["counts"] = dict_of(result.counts);
  const auto& times = result.times;
  fields["milliseconds"] =
      py::make_tuple(times.view_test, times.start, times.ghosts, times.broad_phase,
                     times.narrow_phase, times.closure, times.total);
  fields["doubts"] = array_of<std::uint8_t>(std::move(result.doubts));
  fields["signs"] = array_of<std::int8_t>(std::move(result.signs));
  return fields;
}

}  // namespace assay::python
