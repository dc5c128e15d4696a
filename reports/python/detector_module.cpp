// The module assay._detector holds the production detector and its elementary test, and no oracle.
#include "reports/python/detector_binding.h"
#include "reports/python/query_binding.h"

PYBIND11_MODULE(_detector, module) {
  assay::python::bind_detector(module);
  assay::python::bind_queries(module);
}
