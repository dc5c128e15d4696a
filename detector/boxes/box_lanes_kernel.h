// The code of box_lanes.h. It is compiled once for each instruction set. Everything here has
// internal linkage, and no header with inline functions is included, because code for one
// instruction set must not be linked into code for another.
#include <cstddef>
#include <cstdint>

#include "detector/boxes/box_lanes.h"
#if defined(__AVX2__) || defined(__SSE__)
#include <immintrin.h>
#endif

namespace assay::detector::box_kernel {
namespace {

#define ASSAY_INLINE inline __attribute__((always_inline))

typedef float Lanes __attribute__((vector_size(32)));
typedef int LaneMask __attribute__((vector_size(32)));

ASSAY_INLINE void load(Lanes& out, const float* from) { __builtin_memcpy(&out, from, sizeof(out)); }

ASSAY_INLINE std::uint32_t bits_of(const LaneMask& mask) {
#if defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<const __m256&>(mask)));
#elif defined(__SSE__)
  __m128 half[2];
  __builtin_memcpy(half, &mask, sizeof(mask));
  return static_cast<std::uint32_t>(_mm_movemask_ps(half[0]) | (_mm_movemask_ps(half[1]) << 4));
#else
  std::uint32_t bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint32_t>(mask[i] & 1) << i;
  return bits;
#endif
}

// Returns, as bits, the boxes of b from which `box` is apart: strictly ordered along an axis, in
// the same sense at t=0 and at t=1. From one bound of `box` to the next there are `stride` floats.
template <bool moves>
ASSAY_INLINE std::uint32_t apart_from(const float* box, std::size_t stride, const BoxRows& b) {
  LaneMask apart = {};
  for (std::size_t k = 0; k < 3; ++k) {
    Lanes lo, hi;
    load(lo, b.first + k * b.count);
    load(hi, b.first + (3 + k) * b.count);
    LaneMask below = box[(3 + k) * stride] < lo, above = hi < box[k * stride];
    if (moves) {
      load(lo, b.first + (6 + k) * b.count);
      load(hi, b.first + (9 + k) * b.count);
      below &= box[(9 + k) * stride] < lo;
      above &= hi < box[(6 + k) * stride];
    }
    apart |= below | above;
  }
  return bits_of(apart);
}

ASSAY_INLINE std::uint32_t all_of(const BoxRows& b) { return (1u << b.count) - 1; }

std::uint32_t compare_one_lanes(const float* box, const BoxRows& b) {
  return all_of(b) & ~(b.end ? apart_from<true>(box, 1, b) : apart_from<false>(box, 1, b));
}

template <bool moves>
ASSAY_INLINE std::uint32_t compare_each(const BoxRows& a, const float* box_of_a, const BoxRows& b,
                                        const float* box_of_b, LaneSets& sets) {
  const std::uint32_t near_a = all_of(b) & ~apart_from<moves>(box_of_a, 1, b);
  const std::uint32_t near_b = all_of(a) & ~apart_from<moves>(box_of_b, 1, a);
  std::uint32_t compared = static_cast<std::uint32_t>(a.count + b.count);
  for (std::size_t i = 0; i < a.count; ++i) {
    std::uint32_t set = sets[i] & near_a;
    if (!(near_b >> i & 1)) set = 0;
    if (set) {
      compared += static_cast<std::uint32_t>(__builtin_popcount(set));
      set &= ~apart_from<moves>(a.first + i, a.count, b);
    }
    sets[i] = static_cast<std::uint8_t>(set);
  }
  return compared;
}

std::uint32_t compare_all_lanes(const BoxRows& a, const float* box_of_a, const BoxRows& b,
                                const float* box_of_b, LaneSets& sets) {
  return b.end ? compare_each<true>(a, box_of_a, b, box_of_b, sets)
               : compare_each<false>(a, box_of_a, b, box_of_b, sets);
}

// The bounds of a feature. The margin is added to the upper bounds.
struct FeatureLanes {
  Lanes lo_t0, hi_t0, lo_t1, hi_t1;
};

ASSAY_INLINE bool some(const LaneMask& mask) { return bits_of(mask) != 0; }

ASSAY_INLINE void join(FeatureLanes& out, const FeatureLanes& a, const FeatureLanes& b) {
  out.lo_t0 = a.lo_t0 < b.lo_t0 ? a.lo_t0 : b.lo_t0;
  out.hi_t0 = a.hi_t0 > b.hi_t0 ? a.hi_t0 : b.hi_t0;
  out.lo_t1 = a.lo_t1 < b.lo_t1 ? a.lo_t1 : b.lo_t1;
  out.hi_t1 = a.hi_t1 > b.hi_t1 ? a.hi_t1 : b.hi_t1;
}

ASSAY_INLINE bool meet(const FeatureLanes& a, const FeatureLanes& b) {
  return !some(((a.hi_t0 < b.lo_t0) & (a.hi_t1 < b.lo_t1)) |
               ((b.hi_t0 < a.lo_t0) & (b.hi_t1 < a.lo_t1)));
}

ASSAY_INLINE bool meet_at_start(const FeatureLanes& a, const FeatureLanes& b) {
  return !some((a.hi_t0 < b.lo_t0) | (b.hi_t0 < a.lo_t0));
}

ASSAY_INLINE void corner(FeatureLanes& out, const float* at, std::size_t to_end) {
  load(out.lo_t0, at);
  load(out.lo_t1, at + to_end);
  out.hi_t0 = out.lo_t0;
  out.hi_t1 = out.lo_t1;
}

ASSAY_INLINE void grow(FeatureLanes& box, const Lanes& margin) {
  box.hi_t0 += margin;
  box.hi_t1 += margin;
}

ASSAY_INLINE void edge(FeatureLanes& out, const TriangleCorners& corners, std::size_t to_end,
                       std::size_t i) {
  FeatureLanes p, q;
  corner(p, corners[i == 2 ? 0 : i + 1], to_end);
  corner(q, corners[i == 0 ? 2 : i - 1], to_end);
  join(out, p, q);
}

ASSAY_INLINE void face(FeatureLanes& out, const TriangleCorners& corners, std::size_t to_end,
                       const Lanes& margin) {
  FeatureLanes p;
  edge(out, corners, to_end, 0);
  corner(p, corners[0], to_end);
  join(out, out, p);
  grow(out, margin);
}

ASSAY_INLINE std::size_t lowest(std::uint32_t bits) {
  return static_cast<std::size_t>(__builtin_ctz(bits));
}

// Returns, as bits, the corners in corner_bits whose boxes meet the box `other`.
ASSAY_INLINE std::uint32_t corners_that_meet(const TriangleCorners& corners, std::size_t to_end,
                                             std::uint32_t corner_bits, const FeatureLanes& other,
                                             const Lanes& margin) {
  std::uint32_t found = 0;
  for (; corner_bits != 0; corner_bits &= corner_bits - 1) {
    FeatureLanes p;
    corner(p, corners[lowest(corner_bits)], to_end);
    grow(p, margin);
    if (meet(p, other)) found |= corner_bits & -corner_bits;
  }
  return found;
}

std::uint32_t compare_features_lanes(const TriangleCorners& a, const TriangleCorners& b,
                                     std::size_t to_end, const float* margin, std::uint32_t pairs) {
  Lanes by;
  load(by, margin);
  FeatureLanes face_a, face_b;
  face(face_a, a, to_end, by);
  face(face_b, b, to_end, by);
  if (!meet(face_a, face_b)) return 0;
  constexpr std::uint32_t three = 7;
  std::uint32_t found = corners_that_meet(a, to_end, pairs & three, face_b, by);
  found |= corners_that_meet(b, to_end, pairs >> 3 & three, face_a, by) << 3;
  std::uint32_t edges = pairs >> 6 & 511, starts_a = pairs >> 15 & three, starts_b = pairs >> 18;
  // The edges of b that are in some pair of edges. Those that do not meet the face of a are removed
  // below.
  std::uint32_t edges_b = (edges | edges >> 3 | edges >> 6) & three, left = edges_b | starts_b;
  FeatureLanes boxes_b[3];
  for (; left != 0; left &= left - 1) {
    const std::size_t j = lowest(left);
    edge(boxes_b[j], b, to_end, j);
    grow(boxes_b[j], by);
    if (!meet(boxes_b[j], face_a)) {
      edges_b &= ~(1u << j);
    } else if (starts_b >> j & 1 && meet_at_start(boxes_b[j], face_a)) {
      found |= feature_bits::face_at_start(j);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint32_t partners = edges >> (3 * i) & edges_b;
    if (!(partners | (starts_a >> i & 1))) continue;
    FeatureLanes box;
    edge(box, a, to_end, i);
    grow(box, by);
    if (!meet(box, face_b)) continue;
    if (starts_a >> i & 1 && meet_at_start(box, face_b)) found |= feature_bits::edge_at_start(i);
    for (; partners != 0; partners &= partners - 1) {
      const std::size_t j = lowest(partners);
      if (meet(box, boxes_b[j])) found |= feature_bits::edges(i, j);
    }
  }
  return found;
}

constexpr BoxKernels kernels_of_this_file = {compare_all_lanes, compare_one_lanes,
                                             compare_features_lanes};

#undef ASSAY_INLINE

}  // namespace
}  // namespace assay::detector::box_kernel
