// Compiles the vector code of boxes/box_lanes.h, contact/lanes/query_lanes.h and view/view_lanes.h
// for any machine, and chooses the instruction set when the program runs.
#define ASSAY_LANES 2
#include "detector/boxes/box_lanes_kernel.h"
#include "detector/contact/lanes/query_lanes_kernel.h"
#include "detector/view/view_lanes_kernel.h"

namespace assay::detector {

// Defined in lanes_avx2.cpp and lanes_avx512.cpp. Null if the compiler does not make code for the
// set.
extern const BoxKernels* const avx2_box_kernels;
extern const QueryKernels* const avx2_query_kernels;
extern const LaneKernels* const avx2_lane_kernels;
extern const LaneKernels* const avx512_lane_kernels;

namespace {

bool machine_has(InstructionSet set) {
#if defined(__x86_64__) || defined(__i386__)
  // The answers include whether the operating system saves the wide registers.
  if (set == InstructionSet::avx2)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt");
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
  return &view_kernel::kernels_of_this_file;
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
  return is_available(set) ? *compiled_for(set) : view_kernel::kernels_of_this_file;
}

const BoxKernels& plain_box_kernels() { return box_kernel::kernels_of_this_file; }
const BoxKernels& box_kernels() {
  return is_available(InstructionSet::avx2) ? *avx2_box_kernels : plain_box_kernels();
}

const QueryKernels& plain_query_kernels() { return query_kernel::kernels_of_this_file; }
const QueryKernels& query_kernels() {
  return is_available(InstructionSet::avx2) ? *avx2_query_kernels : plain_query_kernels();
}

}  // namespace assay::detector
