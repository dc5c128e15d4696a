// The vector code for AVX-512. No other file has the flags of AVX-512 (detector/CMakeLists.txt).
#include "detector/view/view_lanes.h"

#ifdef __AVX512F__
#define ASSAY_LANES 8
#include "detector/view/view_lanes_kernel.h"
#endif

namespace assay::detector {

extern const LaneKernels* const avx512_lane_kernels;
#ifdef __AVX512F__
const LaneKernels* const avx512_lane_kernels = &view_kernel::kernels_of_this_file;
#else
const LaneKernels* const avx512_lane_kernels = nullptr;
#endif

}  // namespace assay::detector
