#include "detector/boxes/box_lanes.h"

#include "detector/boxes/box_lanes_kernel.h"

namespace assay::detector {

// Defined in box_lanes_avx2.cpp. Null if the compiler does not make code for it.
extern const BoxKernels* const avx2_box_kernels;

const BoxKernels& plain_box_kernels() { return kernels_of_this_file; }

const BoxKernels& box_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static const bool has_avx2 =
      avx2_box_kernels && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt");
  if (has_avx2) return *avx2_box_kernels;
#endif
  return kernels_of_this_file;
}

}  // namespace assay::detector
