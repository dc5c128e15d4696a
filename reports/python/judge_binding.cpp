#include "reports/python/judge_binding.h"

#include "detector/mesh/mesh_checks.h"
#include "oracle/mesh/step.h"
#include "reports/python/array_arguments.h"
#include "reports/python/input_problem.h"
#include "reports/python/interruption.h"
#include "reports/python/step_arrays.h"

namespace assay::python {
namespace {

namespace py = pybind11;

// The oracle takes the same input as the detector, and refuses other input by the same names.
void demand_good_input(const detector::TrianglesView& triangles,
                       const detector::PositionsView& x_t0, const detector::PositionsView& x_t1) {
  if (const auto bad = detector::check_triangles(triangles, x_t0.rows())) raise(*bad);
  for (const auto* x : {&x_t0, &x_t1})
    if (const auto bad = detector::check_positions(*x, x_t0.rows())) raise(*bad);
}

py::dict judge(const py::object& triangles, const py::object& x_t0, const py::object& x_t1,
               int jobs) {
  const TrianglesArgument mesh(triangles, "triangles");
  const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  demand_good_input(mesh.view(), from.view(), to.view());
  Interruption interruption;
  const auto judgement = [&] {
    const py::gil_scoped_release others_may_run;
    return oracle::judge_step({from.view(), to.view()}, mesh.view(),
                              {jobs, interruption.stop_function()});
  }();
  interruption.raise();
  py::dict fields = arrays_of(judgement.pairs);
  fields["answer"] = name_of(judgement.answer);
  fields["first"] = judgement.answer == detector::Answer::collision
                        ? py::object(py::make_tuple(judgement.first.lo, judgement.first.hi))
                        : py::none();
  fields["feature_candidates"] = judgement.feature_candidates;
  return fields;
}

}  // namespace

void bind_judge(py::module_& module) { module.def("judge", judge); }

}  // namespace assay::python
