#include "reports/python/step_arrays.h"

namespace assay::python {

namespace py = pybind11;

using detector::Answer;
using detector::StepCounts;

namespace {

py::dict dict_of(const StepCounts& counts) {
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

py::dict arrays_of(const std::vector<detector::PairContact>& contacts) {
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
  return fields;
}

py::dict arrays_of(detector::StepResult result) {
  py::dict fields = arrays_of(result.pairs);
  fields["answer"] = name_of(result.answer);
  fields["first"] = result.answer == Answer::collision
                        ? py::object(py::make_tuple(result.first.lo, result.first.hi))
                        : py::none();
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
