// The module assay._judge holds the oracle, `check` and the readers of frames.
#include "reports/python/frames_binding.h"
#include "reports/python/judge_binding.h"

PYBIND11_MODULE(_judge, module) {
  assay::python::bind_judge(module);
  assay::python::bind_check(module);
  assay::python::bind_contact_points(module);
  assay::python::bind_frames(module);
}
