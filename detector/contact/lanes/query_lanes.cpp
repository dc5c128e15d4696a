#include "detector/contact/lanes/query_lanes.h"

#include "detector/contact/contact_pieces.h"
#include "detector/geometry/orientation.h"
#include "detector/mesh/types.h"

namespace assay::detector {

QueryInput query_input(const SteppedMesh& motion) {
  const auto &x_t0 = motion.vertices_t0, &x_t1 = motion.vertices_t1;
  return {x_t0.data(),
          x_t1.data(),
          x_t0.outerStride(),
          x_t1.outerStride(),
          cubic_error(0),
          quadratic_error(0),
          orientation_error<ProvedBounds>,
          least_magnitude,
          greatest_magnitude};
}

}  // namespace assay::detector
