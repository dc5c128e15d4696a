// Compares one moving box with up to eight others by vector instructions. Floats are compared and
// nothing is computed, so every instruction set gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace assay::detector {

namespace box_lanes {
inline constexpr std::size_t width = 8, rows = 12;
}  // namespace box_lanes

// Up to eight boxes as rows of `count` floats (bounding_volume_tree.h). There are twelve rows, or
// six if the mesh is at rest, where the bounds at t=0 and t=1 are the same. At least eight floats
// can be read from the beginning of each row, also if `count` is smaller.
struct BoxRows {
  const float* first;
  std::size_t count;
  std::size_t end = box_lanes::rows / 2;  // the first row of the bounds at t=1; 0 at rest
};

// Element i is a set of boxes of `b`, as bits. Before compare_all it has the boxes to compare with
// box i of `a`; afterwards it has only the boxes from which box i of `a` is not apart.
using LaneSets = std::uint8_t[box_lanes::width];

// A corner of a triangle at t=0 or at t=1 has eight floats: its rounded coordinates, a 0, and its
// sums along the four diagonals (feature_pairs.h). TriangleCorners points to the three corners at
// t=0.
inline constexpr std::size_t floats_of_corner = 8;
using TriangleCorners = const float* [3];

// Bits that say which features of two triangles may meet. The functions are always inlined, because
// code for one instruction set calls them (box_lanes_kernel.h).
namespace feature_bits {
[[gnu::always_inline]] constexpr std::uint32_t corner_on_face(std::size_t i) { return 1u << i; }
[[gnu::always_inline]] constexpr std::uint32_t face_on_corner(std::size_t j) {
  return 1u << (3 + j);
}
[[gnu::always_inline]] constexpr std::uint32_t edges(std::size_t i, std::size_t j) {
  return 1u << (6 + 3 * i + j);
}
[[gnu::always_inline]] constexpr std::uint32_t edge_at_start(std::size_t i) {
  return 1u << (15 + i);
}
[[gnu::always_inline]] constexpr std::uint32_t face_at_start(std::size_t j) {
  return 1u << (18 + j);
}
}  // namespace feature_bits

struct BoxKernels {
  // Clears, in `sets`, the bits of pairs of boxes that are apart. box_of_a bounds all boxes of `a`,
  // and box_of_b bounds all boxes of `b`; each has one float for each row, and they save
  // comparisons. Returns how many boxes were compared. REQUIRES that `a` and `b` both move, or are
  // both at rest.
  std::uint32_t (*compare_all)(const BoxRows& a, const float* box_of_a, const BoxRows& b,
                               const float* box_of_b, LaneSets& sets);
  // Returns, as bits, the boxes of b that are not apart from `box`. `box` has one float for each
  // row of b.
  std::uint32_t (*compare_one)(const float* box, const BoxRows& b);
  // Returns the bits of `pairs` (feature_bits) whose features have boxes that are not apart by more
  // than the margin; 0 if the two triangles are apart. The margin has eight floats. A corner at t=1
  // lies to_end floats after the same corner at t=0. An `at_start` bit compares an edge and a face
  // only by their boxes at t=0. Edge i is opposite to corner i.
  std::uint32_t (*compare_features)(const TriangleCorners& a, const TriangleCorners& b,
                                    std::size_t to_end, const float* margin, std::uint32_t pairs);
};

// Returns the kernels for the best instruction set that this machine has.
const BoxKernels& box_kernels();
// Returns the plain kernels, which every machine can run.
const BoxKernels& plain_box_kernels();

}  // namespace assay::detector
