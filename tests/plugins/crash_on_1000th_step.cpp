// The built-in detector, which dies on the 1000th step of its life.
#include <atomic>
#include <cstdlib>

#include "detector/plugin/assay_builtin_detector.h"

namespace {

std::int32_t evaluate(assay_handle* handle, const double* x_t0, const double* x_t1) {
  static std::atomic<int> steps = 0;
  if (++steps == 1000) std::abort();
  return assay_builtin_detector()->evaluate(handle, x_t0, x_t1);
}

}  // namespace

const assay_detector_api* assay_detector() {
  static const assay_detector_api api = [] {
    assay_detector_api changed = *assay_builtin_detector();
    changed.evaluate = evaluate;
    return changed;
  }();
  return &api;
}
