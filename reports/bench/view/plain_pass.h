// The yardstick of a free step: a pass that does nothing but read what a view test has to read, the
// corners of each triangle at both ends of the step.
#pragma once

#include "detector/mesh/topology.h"
#include "detector/parallel/workers.h"

namespace assay::reports {

// Reads the three corners of every triangle at t=0 and at t=1. The workers share the triangles out.
// The sum is of no use, but without it the compiler would leave the reading out.
double read_plainly(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                    const detector::PositionsView& x_t1, const detector::Workers& workers);

}  // namespace assay::reports
