// The code of query_lanes.h. It is compiled once for each instruction set, by a file that defines
// ASSAY_LANES before it includes this one. Everything here has internal linkage, and no inline
// function of another header is called, because code for one instruction set must not be linked
// into code for another.
//
// Each lane has one query. A lane does the same operations as contact_pieces.h and orientation.cpp,
// so their error bounds hold.
#include <cstddef>
#include <cstdint>

#include "detector/contact/lanes/query_lanes.h"
#include "detector/exact/double_lanes.h"

namespace assay::detector::query_kernel {
namespace {

struct LaneVector {
  Lanes k[3];
};
struct LaneMotion {
  LaneVector t0, t1;
};
// Bernstein coefficients of a cross product.
struct LaneCross {
  LaneVector b0, b1, b2;
};

// Raises `magnitude` to |x| in each lane in which |x| is greater.
ASSAY_INLINE void grow(Lanes& magnitude, const Lanes& x) {
  const Lanes size = x < Lanes{} ? -x : x;
  greater(magnitude, size);
}

ASSAY_INLINE void subtract(LaneVector& out, const LaneVector& a, const LaneVector& b) {
  for (std::size_t k = 0; k < 3; ++k) out.k[k] = a.k[k] - b.k[k];
}

ASSAY_INLINE void cross(LaneVector& out, const LaneVector& a, const LaneVector& b) {
  out.k[0] = a.k[1] * b.k[2] - a.k[2] * b.k[1];
  out.k[1] = a.k[2] * b.k[0] - a.k[0] * b.k[2];
  out.k[2] = a.k[0] * b.k[1] - a.k[1] * b.k[0];
}

ASSAY_INLINE void dot(Lanes& out, const LaneVector& a, const LaneVector& b) {
  out = a.k[0] * b.k[0] + a.k[1] * b.k[1] + a.k[2] * b.k[2];
}

ASSAY_INLINE void cross(LaneCross& out, const LaneMotion& a, const LaneMotion& b) {
  LaneVector p, q;
  cross(out.b0, a.t0, b.t0);
  cross(out.b2, a.t1, b.t1);
  cross(p, a.t0, b.t1);
  cross(q, a.t1, b.t0);
  for (std::size_t k = 0; k < 3; ++k) out.b1.k[k] = (p.k[k] + q.k[k]) / 2;
}

ASSAY_INLINE void gather(LaneVector& out, const double* x, std::ptrdiff_t stride,
                         const QueryVertices* queries, std::size_t point) {
  const double* row[lane_count];
  for (std::size_t i = 0; i < lane_count; ++i) row[i] = x + stride * queries[i].v[point];
  for (std::size_t k = 0; k < 3; ++k) {
#if ASSAY_LANES == 2
    out.k[k] = Lanes{row[0][k], row[1][k]};
#else
    out.k[k] = Lanes{row[0][k], row[1][k], row[2][k], row[3][k]};
#endif
  }
}

// Sets `out` to whether two groups of points are strictly ordered along an axis, in the same sense
// at t=0 and at t=1. The first `split` points are one group, the other points are the second group.
ASSAY_INLINE void ordered(Mask& out, const LaneMotion (&p)[4], std::size_t split) {
  out = Mask{};
  for (std::size_t k = 0; k < 3; ++k) {
    Mask below = ~Mask{}, above = ~Mask{};
    constexpr LaneVector LaneMotion::*ends[] = {&LaneMotion::t0, &LaneMotion::t1};
    for (const auto end : ends) {
      Lanes lo[2], hi[2];
      for (std::size_t i = 0; i < 4; ++i) {
        const Lanes& x = (p[i].*end).k[k];
        const std::size_t group = i < split ? 0 : 1;
        if (i == 0 || i == split) {
          lo[group] = hi[group] = x;
        } else {
          lesser(lo[group], x);
          greater(hi[group], x);
        }
      }
      below &= hi[0] < lo[1];
      above &= hi[1] < lo[0];
    }
    out |= below | above;
  }
}

// Sets `out` to whether the magnitudes are in the range in which the bounds hold.
ASSAY_INLINE void in_range(Mask& out, const QueryInput& in, const LaneVector& magnitude,
                           bool zero_too) {
  out = ~Mask{};
  for (const Lanes& m : magnitude.k) {
    Mask holds = (m > all(in.least_magnitude)) & (m < all(in.greatest_magnitude));
    if (zero_too) holds |= m == Lanes{};
    out &= holds;
  }
}

ASSAY_INLINE bool everywhere(const Mask& mask) {
  bool result = true;
  for (std::size_t i = 0; i < lane_count; ++i) result &= mask[i] != 0;
  return result;
}

// Sets `out` to whether all coefficients of the coplanarity cubic F certainly have one sign.
ASSAY_INLINE void never_coplanar(Mask& out, const QueryInput& in, const LaneMotion& w,
                                 const LaneCross& n, const LaneVector& magnitude) {
  Lanes first, middle, f[4];
  dot(f[0], w.t0, n.b0);
  dot(middle, w.t0, n.b1);
  dot(first, w.t1, n.b0);
  f[1] = (2 * middle + first) / 3;
  dot(first, w.t0, n.b2);
  dot(middle, w.t1, n.b1);
  f[2] = (first + 2 * middle) / 3;
  dot(f[3], w.t1, n.b2);
  Lanes least = f[0], greatest = f[0];
  for (std::size_t i = 1; i < 4; ++i) {
    lesser(least, f[i]);
    greater(greatest, f[i]);
  }
  const Lanes bound = all(in.cubic_error) * (magnitude.k[0] * magnitude.k[1] * magnitude.k[2]);
  out = (least > bound) | (greatest < -bound);
}

// Sets `out` to whether, for some axis, two of the L_k,i (contact_pieces.h) certainly have opposite
// signs over the whole step.
ASSAY_INLINE void never_meet(Mask& out, const QueryInput& in, const LaneCross (&lam)[3],
                             const LaneVector& magnitude, std::size_t split) {
  out = Mask{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes bound =
        all(in.dependency_error) * (magnitude.k[(k + 1) % 3] * magnitude.k[(k + 2) % 3]);
    Mask positive = Mask{}, negative = Mask{};
    Lanes l[4][3];
    for (std::size_t i = 0; i < 3; ++i) {
      l[i + 1][0] = lam[i].b0.k[k];
      l[i + 1][1] = lam[i].b1.k[k];
      l[i + 1][2] = lam[i].b2.k[k];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      l[0][c] = -(l[1][c] + l[2][c] + l[3][c]);
      for (std::size_t i = split; i < 4; ++i) l[i][c] = -l[i][c];
    }
    for (const auto& of_point : l) {
      Lanes least = of_point[0], greatest = of_point[0];
      for (std::size_t c = 1; c < 3; ++c) {
        lesser(least, of_point[c]);
        greater(greatest, of_point[c]);
      }
      positive |= least > bound;
      negative |= greatest < -bound;
    }
    out |= positive & negative;
  }
}

ASSAY_INLINE void write(LaneRung* rungs, const Mask& apart, const Mask& free) {
  for (std::size_t i = 0; i < lane_count; ++i)
    rungs[i] = apart[i] ? LaneRung::axis : free[i] ? LaneRung::filter : LaneRung::open;
}

template <std::size_t split>
ASSAY_INLINE void contact_group(const QueryInput& in, const QueryVertices* queries,
                                LaneRung* rungs) {
  LaneMotion p[4];
  for (std::size_t i = 0; i < 4; ++i) {
    gather(p[i].t0, in.x_t0, in.stride_t0, queries, i);
    gather(p[i].t1, in.x_t1, in.stride_t1, queries, i);
  }
  LaneMotion u[3];
  LaneVector magnitude = {};
  for (std::size_t j = 0; j < 3; ++j) {
    subtract(u[j].t0, p[j + 1].t0, p[0].t0);
    subtract(u[j].t1, p[j + 1].t1, p[0].t1);
    for (std::size_t k = 0; k < 3; ++k) {
      grow(magnitude.k[k], u[j].t0.k[k]);
      grow(magnitude.k[k], u[j].t1.k[k]);
    }
  }
  Mask apart, holds, free, sorted;
  ordered(apart, p, split);
  in_range(holds, in, magnitude, true);
  LaneCross lam[3];
  cross(lam[0], u[1], u[2]);
  never_coplanar(free, in, u[0], lam[0], magnitude);
  if (!everywhere(free | apart)) {
    cross(lam[1], u[2], u[0]);
    cross(lam[2], u[0], u[1]);
    never_meet(sorted, in, lam, magnitude, split);
    free |= sorted;
  }
  write(rungs, apart, free & holds);
}

// Sets `out` to u[i] . (u[j] x u[k]).
ASSAY_INLINE void volume(Lanes& out, const LaneVector (&u)[4], std::size_t i, std::size_t j,
                         std::size_t k) {
  LaneVector n;
  cross(n, u[j], u[k]);
  dot(out, u[i], n);
}

// Sets u to the differences of four points from the first point in `points`. Sets `bound` to the
// error bound of volume() of these differences, and `holds` to whether the bound holds.
ASSAY_INLINE void differences(LaneVector (&u)[4], Lanes& bound, Mask& holds, const QueryInput& in,
                              const LaneVector (&p)[5], const std::size_t (&points)[5]) {
  LaneVector magnitude = {};
  for (std::size_t j = 0; j < 4; ++j) {
    subtract(u[j], p[points[j + 1]], p[points[0]]);
    for (std::size_t k = 0; k < 3; ++k) grow(magnitude.k[k], u[j].k[k]);
  }
  in_range(holds, in, magnitude, false);
  bound = all(in.orientation_error) * (magnitude.k[0] * magnitude.k[1] * magnitude.k[2]);
}

ASSAY_INLINE void piercing_group(const QueryInput& in, const QueryVertices* queries,
                                 LaneRung* rungs) {
  LaneVector p[5];
  for (std::size_t i = 0; i < 5; ++i) gather(p[i], in.x_t0, in.stride_t0, queries, i);
  LaneVector u[4];
  Lanes bound, volumes[3];
  Mask holds;
  // There is no piercing if both ends of the edge are strictly on one side of the triangle's plane.
  differences(u, bound, holds, in, p, {2, 3, 4, 0, 1});
  volume(volumes[0], u, 2, 0, 1);
  volume(volumes[1], u, 3, 0, 1);
  Mask free = holds & (((volumes[0] > bound) & (volumes[1] > bound)) |
                       ((volumes[0] < -bound) & (volumes[1] < -bound)));
  if (!everywhere(free)) {
    // There is no piercing if the volumes of the edge with two sides of the triangle differ in
    // sign: then the line through the edge misses the triangle.
    differences(u, bound, holds, in, p, {0, 1, 2, 3, 4});
    volume(volumes[0], u, 0, 1, 2);
    volume(volumes[1], u, 0, 2, 3);
    volume(volumes[2], u, 0, 3, 1);
    Lanes least = volumes[0], greatest = volumes[0];
    for (std::size_t i = 1; i < 3; ++i) {
      lesser(least, volumes[i]);
      greater(greatest, volumes[i]);
    }
    free |= holds & (least < -bound) & (greatest > bound);
  }
  write(rungs, Mask{}, free);
}

typedef void (*Group)(const QueryInput&, const QueryVertices*, LaneRung*);

template <Group group>
void kernel(const QueryInput& input, const QueryVertices* queries, std::size_t count,
            LaneRung* rungs) {
  std::size_t i = 0;
  for (; i + lane_count <= count; i += lane_count) group(input, queries + i, rungs + i);
  if (i == count) return;
  // The last queries do not fill the lanes, so the last one is repeated.
  QueryVertices rest[lane_count];
  LaneRung rest_rungs[lane_count];
  for (std::size_t k = 0; k < lane_count; ++k) rest[k] = queries[i + k < count ? i + k : count - 1];
  group(input, rest, rest_rungs);
  for (std::size_t k = 0; i + k < count; ++k) rungs[i + k] = rest_rungs[k];
}

constexpr QueryKernels kernels_of_this_file = {kernel<contact_group<1>>, kernel<contact_group<2>>,
                                               kernel<piercing_group>};

}  // namespace
}  // namespace assay::detector::query_kernel
