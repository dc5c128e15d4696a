// What the C interface keeps for a mesh: the detector, and the last result as C arrays.
#pragma once

#include <new>
#include <span>
#include <vector>

#include "detector/detector.h"
#include "detector/plugin/assay_builtin_detector.h"

struct assay_handle {
  assay::detector::Detector detector;
  Eigen::Index vertex_count;
  assay::detector::StepResult result = {};
  assay::detector::StepLimit limit = {};
  std::vector<std::int32_t> pairs = {};
  std::vector<double> times = {};

  // As those of Detector, and they keep the result. If memory runs out the handle keeps its last
  // result unchanged.
  void evaluate(const double* x_t0, const double* x_t1,
                std::span<const assay::detector::ViewPrimitive> primitives = {},
                const assay::detector::StopFunction& stop = {});
  void first_contact(const double* x_t0, const double* x_t1, double until,
                     const assay::detector::StopFunction& stop);

 private:
  void keep(assay::detector::StepResult next);
};

namespace assay::detector {

using PositionsMap = Eigen::Map<const Positions>;
using TrianglesMap = Eigen::Map<const Triangles>;

// Calls function(), and out_of_memory() in its place if memory runs out. The built-in detector
// throws nothing but std::bad_alloc, so no exception crosses the border to C.
template <class Function, class OutOfMemory>
std::int32_t guarded(const Function& function, const OutOfMemory& out_of_memory) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace assay::detector
