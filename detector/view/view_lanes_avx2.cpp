// Compiled with the flags of this instruction set alone (detector/CMakeLists.txt).
#include "detector/view/view_lanes.h"

#ifdef __AVX2__
#define ASSAY_LANES 4
#include "detector/view/view_lanes_kernel.h"
#endif

namespace assay::detector {

extern const LaneKernels* const avx2_lane_kernels;
#ifdef __AVX2__
const LaneKernels* const avx2_lane_kernels = &kernels_of_this_file;
#else
const LaneKernels* const avx2_lane_kernels = nullptr;
#endif

}  // namespace assay::detector
