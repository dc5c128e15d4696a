#include "detector/view/view_lanes.h"

#define ASSAY_LANES 2
#include "detector/view/view_lanes_kernel.h"

namespace assay::detector {

// Defined in view_lanes_avx2.cpp and view_lanes_avx512.cpp. Null if the compiler does not make
// code for the set.
extern const LaneKernels* const avx2_lane_kernels;
extern const LaneKernels* const avx512_lane_kernels;

namespace {

bool machine_has(InstructionSet set) {
#if defined(__x86_64__) || defined(__i386__)
  // The answers include whether the operating system saves the wide registers.
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
  if (set == InstructionSet::avx512) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
  }
#endif
  return set == InstructionSet::baseline;
}

const LaneKernels* compiled_for(InstructionSet set) {
  if (set == InstructionSet::avx2) return avx2_lane_kernels;
  if (set == InstructionSet::avx512) return avx512_lane_kernels;
  return &kernels_of_this_file;
}

}  // namespace

bool is_available(InstructionSet set) { return compiled_for(set) && machine_has(set); }

InstructionSet best_instruction_set() {
  static const InstructionSet best = is_available(InstructionSet::avx512) ? InstructionSet::avx512
                                     : is_available(InstructionSet::avx2)
                                         ? InstructionSet::avx2
                                         : InstructionSet::baseline;
  return best;
}

const LaneKernels& lane_kernels(InstructionSet set) {
  return is_available(set) ? *compiled_for(set) : kernels_of_this_file;
}

}  // namespace assay::detector
