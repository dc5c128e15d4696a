// The yardsticks of the view test and of a free step: plain loops over the same arrays. Any method
// with bounding volumes writes boxes first, and any view test reads all corners.
#pragma once

#include <array>
#include <vector>

#include "detector/mesh/topology.h"
#include "detector/parallel/workers.h"

namespace assay::reports {

// The box of a triangle swept over a step: least x, y, z, largest x, y, z.
using SweptBox = std::array<double, 6>;

// Writes the boxes by an indexed loop, six doubles for each triangle. REQUIRES that `boxes` has one
// entry for each triangle already.
void write_swept_boxes(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                       const detector::PositionsView& x_t1, std::vector<SweptBox>& boxes);

// Does nothing but read the three corners of every triangle at t=0 and at t=1. The workers share
// the triangles out. The sum is of no use, but without it the compiler would leave the reading out.
double read_plainly(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                    const detector::PositionsView& x_t1, const detector::Workers& workers);

}  // namespace assay::reports
