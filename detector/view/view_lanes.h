// The first rungs of the view test, for many triangles at once: one triangle a lane, in double,
// with proved bounds. What a lane does is the same sequence of roundings whatever the instruction
// set and the number of lanes, so results are the same bytes on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace assay::detector {

// What all lanes share. The constants are derived in view_bounds.cpp.
struct LaneInput {
  const double *x_t0, *x_t1;            // rows of three coordinates
  std::ptrdiff_t stride_t0, stride_t1;  // doubles from row to row
  const std::int32_t* corners;          // three rows a triangle
  double q0_t0[3], q0_t1[3];
  double q1_t0[3], q1_t1[3];

  // A point: coefficients of the cubic, the middle two times 3, are off by less than this.
  double cubic_error;
  // A line, d = q1 - q0.
  double d_t0[3], d_t1[3];
  double length2_reciprocals[3];  // of the coefficients of d.d, the middle one times 2
  double axial_error;             // of a ratio of coefficients (p-q0).d / d.d
  double value_error;             // of (1-s) h0 + s h1 at a given s
  double end_error;               // of the same at t=0 or 1, at a computed s
};

// A sign as in ViewSign, or what doubles could not tell.
inline constexpr std::int8_t lane_open = 2;

// Writes signs[i] for triangles[i], i < count. No allocation.
using LaneKernel = void (*)(const LaneInput& input, const std::int32_t* triangles,
                            std::size_t count, std::int8_t* signs);

struct LaneKernels {
  std::size_t lanes;        // triangles at once
  LaneKernel point;         // the cubic of L1, L2; signs at both ends
  LaneKernel two_cubics;    // a line: h0 and h1 of one strict sign
  LaneKernel middle_piece;  // a line: (1-s) h0 + s h1 with s bounded over the step
};

// Lanes: 2, 4, 8.
enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };

// Whether it was compiled in and this machine has it; the baseline always.
bool is_available(InstructionSet set);
InstructionSet best_instruction_set();

// Those of the baseline where `set` is not available.
const LaneKernels& lane_kernels(InstructionSet set);

}  // namespace assay::detector
