// A step before its stages have run.
#pragma once

#include "detector/step/release_rule.h"
#include "tests/detector/points.h"

namespace assay::tests {

// The first `vertices` rows are vertices of the mesh, and the rows behind them are apexes.
struct BareStep {
  BareStep(const detector::Triangles& triangles, const detector::Positions& from,
           const detector::Positions& to, Eigen::Index vertices)
      : x_t0(from),
        x_t1(to),
        surface(detector::make_surface(triangles, vertices)),
        tree(surface.mesh, x_t0.topRows(vertices)) {}
  BareStep(const detector::Triangles& triangles, const detector::Positions& x)
      : BareStep(triangles, x, x, x.rows()) {}

  detector::Positions x_t0, x_t1;
  detector::Surface surface;
  detector::BoundingVolumeTree tree;
  detector::BoundaryHandler boundary;
  detector::ElementaryTest elementary;
  detector::StopFunction stop;
  detector::GivenStep step{surface, tree, boundary, elementary, stop, {x_t0, x_t1}, nullptr};
  detector::StepMarks marks;
  detector::StepCost cost{.pace = detector::PacedStop(stop)};
};

}  // namespace assay::tests
