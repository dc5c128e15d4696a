// The data that the built-in detector in C has for a mesh: the detector, and the last result as C
// arrays.
#pragma once

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

  // These functions do what the functions of Detector do, and store the result in this handle. If
  // memory runs out, the handle keeps its last result unchanged.
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

}  // namespace assay::detector
