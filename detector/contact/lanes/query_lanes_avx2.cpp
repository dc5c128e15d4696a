// Compiled with the flags of this instruction set alone (detector/CMakeLists.txt).
#include "detector/contact/lanes/query_lanes.h"

#ifdef __AVX2__
#define ASSAY_LANES 4
#include "detector/contact/lanes/query_lanes_kernel.h"
#endif

namespace assay::detector {

extern const QueryKernels* const avx2_query_kernels;
#ifdef __AVX2__
const QueryKernels* const avx2_query_kernels = &kernels_of_this_file;
#else
const QueryKernels* const avx2_query_kernels = nullptr;
#endif

}  // namespace assay::detector
