// The yardstick of the view test: boxes of triangles swept over a step, written from the same
// arrays by a plain indexed loop, six doubles for each triangle. Any bounding-volume method does
// this first.
#pragma once

#include <array>
#include <vector>

#include "detector/mesh/topology.h"

namespace assay::reports {

using SweptBox = std::array<double, 6>;  // least x, y, z, largest x, y, z

// REQUIRES that `boxes` has one entry for each triangle already.
void write_swept_boxes(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                       const detector::PositionsView& x_t1, std::vector<SweptBox>& boxes);

}  // namespace assay::reports
