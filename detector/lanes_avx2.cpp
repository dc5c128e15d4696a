// The vector code for AVX2. No other file has the flags of AVX2 (detector/CMakeLists.txt).
#include "detector/boxes/box_lanes.h"
#include "detector/contact/lanes/query_lanes.h"
#include "detector/view/view_lanes.h"

#ifdef __AVX2__
#define ASSAY_LANES 4
#include "detector/boxes/box_lanes_kernel.h"
#include "detector/contact/lanes/query_lanes_kernel.h"
#include "detector/view/view_lanes_kernel.h"
#define ASSAY_KERNELS(of) &of::kernels_of_this_file
#else
#define ASSAY_KERNELS(of) nullptr
#endif

namespace assay::detector {

extern const BoxKernels* const avx2_box_kernels;
extern const QueryKernels* const avx2_query_kernels;
extern const LaneKernels* const avx2_lane_kernels;
const BoxKernels* const avx2_box_kernels = ASSAY_KERNELS(box_kernel);
const QueryKernels* const avx2_query_kernels = ASSAY_KERNELS(query_kernel);
const LaneKernels* const avx2_lane_kernels = ASSAY_KERNELS(view_kernel);

}  // namespace assay::detector
