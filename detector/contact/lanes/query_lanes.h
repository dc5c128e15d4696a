// The first rungs of the elementary test for many feature pairs at once, one in each lane: order
// along an axis, and doubles with proved bounds over the whole step (contact/rungs.h, without
// halving). These rungs decide most feature pairs of a mesh. The elementary test decides the rest,
// so answers do not depend on lanes. A lane rounds in the same way with every instruction set, so
// counts do not depend on the instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace assay::detector {

struct SteppedMesh;  // mesh/types.h, which code for one instruction set must not include

// The mesh vertices of a query: v f0 f1 f2, a0 a1 b0 b1, or e0 e1 f0 f1 f2.
struct QueryVertices {
  std::int32_t v[5];
};

// The input that all lanes share. The error bounds are those of contact_pieces.h and orientation.h.
struct QueryInput {
  const double *x_t0, *x_t1;            // rows of three coordinates
  std::ptrdiff_t stride_t0, stride_t1;  // doubles from row to row
  double cubic_error, dependency_error, orientation_error;
  double least_magnitude, greatest_magnitude;  // the range in which the bounds hold
};
// Returns the input for `motion`. The positions of `motion` must outlive the input.
QueryInput query_input(const SteppedMesh& motion);

// The result of a lane. axis: the two groups are strictly ordered along an axis. filter: doubles
// show that there is no contact (no piercing). open: the lane has not decided the query.
enum class LaneRung : std::uint8_t { open, axis, filter };

// Writes rungs[i] for queries[i], for all i < count. No allocation.
using QueryKernel = void (*)(const QueryInput& input, const QueryVertices* queries,
                             std::size_t count, LaneRung* rungs);

// The kernels of one instruction set. A contact query takes 15 to 25 ns with AVX2.
struct QueryKernels {
  QueryKernel vertex_face, edge_edge;
  QueryKernel piercing;  // of a triangle by an edge, at t=0; never writes `axis`
};

// Returns the kernels for the best instruction set that this machine has.
const QueryKernels& query_kernels();
// Returns the plain kernels, which every machine can run.
const QueryKernels& plain_query_kernels();

}  // namespace assay::detector
