// The code of box_lanes.h. It is compiled once for each instruction set. Everything here has
// internal linkage, and no header with inline functions is included, because code for one
// instruction set must not reach the others.
#include <cstddef>
#include <cstdint>

#include "detector/search/box_lanes.h"
#if defined(__AVX2__) || defined(__SSE__)
#include <immintrin.h>
#endif

namespace assay::detector {
namespace {

#define ASSAY_INLINE inline __attribute__((always_inline))

typedef float Lanes __attribute__((vector_size(32)));
typedef int LaneMask __attribute__((vector_size(32)));

ASSAY_INLINE void load(Lanes& out, const float* from) {
  __builtin_memcpy(&out, from, sizeof(out));
}

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

// The boxes of b that the box is apart from: strictly ordered along an axis, in the same sense at
// both ends of the step. The twelve bounds of the box are `stride` apart.
ASSAY_INLINE std::uint32_t apart_from(const float* box, std::size_t stride, const BoxRows& b) {
  LaneMask apart = {};
  for (std::size_t k = 0; k < 3; ++k) {
    Lanes lo_t0, hi_t0, lo_t1, hi_t1;
    load(lo_t0, b.first + k * b.count);
    load(hi_t0, b.first + (3 + k) * b.count);
    load(lo_t1, b.first + (6 + k) * b.count);
    load(hi_t1, b.first + (9 + k) * b.count);
    apart |= (box[(3 + k) * stride] < lo_t0) & (box[(9 + k) * stride] < lo_t1);
    apart |= (hi_t0 < box[k * stride]) & (hi_t1 < box[(6 + k) * stride]);
  }
  return bits_of(apart);
}

ASSAY_INLINE std::uint32_t all_of(const BoxRows& b) { return (1u << b.count) - 1; }

std::uint32_t compare_one_lanes(const float* box, const BoxRows& b) {
  return all_of(b) & ~apart_from(box, 1, b);
}

std::uint32_t compare_all_lanes(const BoxRows& a, const float* box_of_a, const BoxRows& b,
                                const float* box_of_b, LaneSets& sets) {
  const std::uint32_t near_a = all_of(b) & ~apart_from(box_of_a, 1, b);
  const std::uint32_t near_b = all_of(a) & ~apart_from(box_of_b, 1, a);
  std::uint32_t compared = static_cast<std::uint32_t>(a.count + b.count);
  for (std::size_t i = 0; i < a.count; ++i) {
    std::uint32_t asked = sets[i] & near_a;
    if (!(near_b >> i & 1)) asked = 0;
    if (asked) {
      compared += static_cast<std::uint32_t>(__builtin_popcount(asked));
      asked &= ~apart_from(a.first + i, a.count, b);
    }
    sets[i] = static_cast<std::uint8_t>(asked);
  }
  return compared;
}

constexpr BoxKernels kernels_of_this_file = {compare_all_lanes, compare_one_lanes};

#undef ASSAY_INLINE

}  // namespace
}  // namespace assay::detector
