#include "detector/contact/lanes/query_lanes.h"

#include "detector/contact/contact_pieces.h"
#include "detector/geometry/orientation.h"
#include "detector/mesh/types.h"

#define ASSAY_LANES 2
#include "detector/contact/lanes/query_lanes_kernel.h"

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

// Defined in query_lanes_avx2.cpp. Null if the compiler does not make code for it.
extern const QueryKernels* const avx2_query_kernels;

const QueryKernels& plain_query_kernels() { return kernels_of_this_file; }

const QueryKernels& query_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static const bool has_avx2 = avx2_query_kernels && __builtin_cpu_supports("avx2");
  if (has_avx2) return *avx2_query_kernels;
#endif
  return kernels_of_this_file;
}

}  // namespace assay::detector
