#include "reports/python/query_binding.h"

#include <limits>

#include "detector/contact/elementary.h"
#include "reports/python/array_arguments.h"
#include "reports/python/interruption.h"

namespace assay::python {
namespace {

namespace py = pybind11;

// After this many queries it is asked whether signals have come. They take about a millisecond.
constexpr std::size_t queries_of_a_piece = 1024;

void answer(const QueriesArgument& x_t0, const QueriesArgument& x_t1, int first_group, bool* hit,
            double* lo, double* hi, const detector::StopFunction& stop) {
  constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < x_t0.count(); ++k) {
    if (k % queries_of_a_piece == 0 && stop()) return;
    detector::FourPoints query;
    query.first_group = first_group;
    for (std::size_t i = 0; i < QueriesArgument::points; ++i)
      query.points[i] = {x_t0.point(k, i), x_t1.point(k, i)};
    const auto result = detector::test_contact(query, detector::Want::first_time);
    hit[k] = result.contact;
    lo[k] = result.contact ? result.time.lo : no_time;
    hi[k] = result.contact ? result.time.hi : no_time;
  }
}

py::tuple answers(const py::object& x_t0, const py::object& x_t1, int first_group) {
  const QueriesArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  if (from.count() != to.count())
    throw py::value_error("x_t0 has " + std::to_string(from.count()) + " queries, x_t1 " +
                          std::to_string(to.count()));
  const auto count = static_cast<py::ssize_t>(from.count());
  py::array_t<bool> hit(count);
  py::array_t<double> lo(count), hi(count);
  Interruption interruption;
  {
    bool* hits = hit.mutable_data();
    double *los = lo.mutable_data(), *his = hi.mutable_data();
    const py::gil_scoped_release others_may_run;
    answer(from, to, first_group, hits, los, his, interruption.stop_function());
  }
  interruption.raise();
  return py::make_tuple(hit, lo, hi);
}

}  // namespace

void bind_queries(py::module_& module) {
  module.def("vertex_face",
             [](const py::object& x_t0, const py::object& x_t1) { return answers(x_t0, x_t1, 1); });
  module.def("edge_edge",
             [](const py::object& x_t0, const py::object& x_t1) { return answers(x_t0, x_t1, 2); });
}

}  // namespace assay::python
