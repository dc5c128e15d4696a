// Comparisons of moving boxes, one with up to eight, by vector instructions. Floats are compared
// and nothing is computed, so every instruction set gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace assay::detector {

namespace box_lanes {
inline constexpr std::size_t width = 8, rows = 12;
}  // namespace box_lanes

// Up to eight boxes as rows of `count` floats (bounding_volume_tree.h): twelve, or of a mesh at
// rest six, which are the bounds at both ends. Eight floats may be read from each row, whatever the
// count is.
struct BoxRows {
  const float* first;
  std::size_t count;
  std::size_t end = box_lanes::rows / 2;  // the first row of the bounds at t=1; 0 at rest
};

// For each box i of a, the boxes of b that it is asked about, as bits, and then those of them that
// it is not apart from.
using LaneSets = std::uint8_t[box_lanes::width];

// A corner of a triangle at one end of the step: its rounded coordinates and a 0, sums along the
// four diagonals (feature_pairs.h). Given are the corners at t=0.
inline constexpr std::size_t floats_of_corner = 8;
using TriangleCorners = const float* [3];

// Which features of two triangles may meet, as bits. They are always inlined, because code for one
// instruction set calls them (box_lanes_kernel.h).
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
  // Clears the bits of the boxes that are apart. box_of_a and box_of_b are as many floats as a box
  // has rows, and bound all boxes of a and of b; they spare comparisons. Returns how many boxes
  // were compared. REQUIRES that both move, or that both are at rest.
  std::uint32_t (*compare_all)(const BoxRows& a, const float* box_of_a, const BoxRows& b,
                               const float* box_of_b, LaneSets& sets);
  // The boxes of b that are not apart from one box, of as many floats as they have rows, as bits.
  std::uint32_t (*compare_one)(const float* box, const BoxRows& b);
  // Of the features asked for, those whose boxes are not apart by more than the margin, which has
  // eight floats. The end of each corner stands so many floats after its start. Of an edge and a
  // face `at_start` counts the boxes at t=0 alone. Edge i is opposite to corner i. Nothing, if the
  // two triangles are apart.
  std::uint32_t (*compare_features)(const TriangleCorners& a, const TriangleCorners& b,
                                    std::size_t to_end, const float* margin, std::uint32_t pairs);
};

// Those of the best instruction set that this machine has.
const BoxKernels& box_kernels();
// The plain ones, which every machine has.
const BoxKernels& plain_box_kernels();

}  // namespace assay::detector
