// Compiled with the flags of this instruction set alone (detector/CMakeLists.txt).
#include "detector/boxes/box_lanes.h"

#ifdef __AVX2__
#include "detector/boxes/box_lanes_kernel.h"
#endif

namespace assay::detector {

extern const BoxKernels* const avx2_box_kernels;
#ifdef __AVX2__
const BoxKernels* const avx2_box_kernels = &kernels_of_this_file;
#else
const BoxKernels* const avx2_box_kernels = nullptr;
#endif

}  // namespace assay::detector
