// The first rungs of the view test, for many triangles at once: one triangle in each lane, in
// double, with proved bounds. A lane rounds in the same way with every instruction set and every
// number of lanes, so results have the same bytes on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace assay::detector {

// The input that all lanes share. view_bounds.cpp derives the error bounds.
struct LaneInput {
  const double *x_t0, *x_t1;            // rows of three coordinates
  std::ptrdiff_t stride_t0, stride_t1;  // doubles from row to row
  const std::int32_t* corners;          // three rows a triangle
  double q0_t0[3], q0_t1[3];
  double q1_t0[3], q1_t1[3];

  // The coefficients of a cubic (the middle two multiplied by 3) are off by less than this.
  double cubic_error;
  // The members below are for a line, with d = q1 - q0.
  double d_t0[3], d_t1[3];
  double length2_reciprocals[3];  // 1 / each coefficient of d.d, the middle one doubled first
  double axial_error;             // error of a ratio of coefficients (p-q0).d / d.d
  double value_error;             // error of (1-s) h0 + s h1 at a given s
  double end_error;               // error of (1-s) h0 + s h1 at t=0 or t=1, at a computed s
};

// A lane writes the value of a ViewSign, or lane_open if doubles cannot tell the sign.
inline constexpr std::int8_t lane_open = 2;

// Writes signs[i] for triangles[i], for all i < count. No allocation.
using LaneKernel = void (*)(const LaneInput& input, const std::int32_t* triangles,
                            std::size_t count, std::int8_t* signs);

struct LaneKernels {
  std::size_t lanes;        // the number of triangles that are tested at once
  LaneKernel point;         // for a point: by the cubic of L1, L2 and its signs at t=0 and t=1
  LaneKernel two_cubics;    // for a line: decides if h0 and h1 have the same strict sign
  LaneKernel middle_piece;  // for a line: by (1-s) h0 + s h1, with s bounded over the step
};

// Sets of instructions for kernels with 2, 4 and 8 lanes.
enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };

// Returns whether the library has code for `set` and this machine can run it. The baseline is
// always available.
bool is_available(InstructionSet set);
InstructionSet best_instruction_set();

// Returns the kernels for `set`, or the baseline kernels if `set` is not available.
const LaneKernels& lane_kernels(InstructionSet set);

}  // namespace assay::detector
