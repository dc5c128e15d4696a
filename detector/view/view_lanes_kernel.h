// The code of view_lanes.h. It is compiled once for each instruction set, by a file that defines
// ASSAY_LANES before it includes this one. Everything here has internal linkage, and no header with
// inline functions is included, because code for one instruction set must not be linked into code
// for another.
//
// Each lane has one triangle, with N = (p1-p0) x (p2-p0) and Bernstein coefficients over the step:
//
// - h = (p0-q).N is stored as h[0], 3 h[1], 3 h[2], h[3]. If all four have one sign, the cubic has
//   that sign.
// - s = (p-q0).d / d.d is a ratio of quadratics. It is a weighted mean of the ratios of their
//   coefficients; the weights are made of the coefficients of d.d, which are all positive. So s
//   lies between the least and the greatest of these ratios.
// - (1-s) h0 + s h1 is, at any time, a weighted mean of the four values (1-s) h0[j] + s h1[j] with
//   the same s. Each of the four is linear in s, so it is least and greatest where s is least or
//   greatest. The range of s is taken over the whole step and over all three corners.
#include <cstddef>
#include <cstdint>

#include "detector/exact/double_lanes.h"
#include "detector/view/view_lanes.h"

namespace assay::detector::view_kernel {
namespace {

struct LaneVector {
  Lanes x, y, z;
};
struct LaneMotion {
  LaneVector t0, t1;
};
struct LaneCubic {
  Lanes b0, b1, b2, b3;  // the middle two times 3
};

ASSAY_INLINE void subtract(LaneVector& out, const LaneVector& a, const LaneVector& b) {
  out = {a.x - b.x, a.y - b.y, a.z - b.z};
}

ASSAY_INLINE void subtract(LaneVector& out, const LaneVector& a, const double (&b)[3]) {
  out = {a.x - b[0], a.y - b[1], a.z - b[2]};
}

ASSAY_INLINE void cross(LaneVector& out, const LaneVector& a, const LaneVector& b) {
  out = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

ASSAY_INLINE void dot(Lanes& out, const LaneVector& a, const LaneVector& b) {
  out = a.x * b.x + a.y * b.y + a.z * b.z;
}

ASSAY_INLINE void dot(Lanes& out, const LaneVector& a, const double (&b)[3]) {
  out = a.x * b[0] + a.y * b[1] + a.z * b[2];
}

// Replaces s by the nearest number of [0,1].
ASSAY_INLINE void clamp_to_unit(Lanes& s) {
  lesser(s, all(1));
  greater(s, Lanes{});
}

ASSAY_INLINE void gather(LaneVector& out, const double* x, std::ptrdiff_t stride,
                         const std::int32_t (&rows)[lane_count]) {
  const double* row[lane_count];
  for (std::size_t i = 0; i < lane_count; ++i) row[i] = x + stride * rows[i];
#if ASSAY_LANES == 2
  out = {Lanes{row[0][0], row[1][0]}, Lanes{row[0][1], row[1][1]}, Lanes{row[0][2], row[1][2]}};
#elif ASSAY_LANES == 4
#define ASSAY_COLUMN(k) Lanes{row[0][k], row[1][k], row[2][k], row[3][k]}
  out = {ASSAY_COLUMN(0), ASSAY_COLUMN(1), ASSAY_COLUMN(2)};
#else
#define ASSAY_COLUMN(k) \
  Lanes{row[0][k], row[1][k], row[2][k], row[3][k], row[4][k], row[5][k], row[6][k], row[7][k]}
  out = {ASSAY_COLUMN(0), ASSAY_COLUMN(1), ASSAY_COLUMN(2)};
#endif
}

struct LaneTriangle {
  LaneMotion p0, e1, e2;
};

ASSAY_INLINE void load(LaneTriangle& out, const LaneInput& in, const std::int32_t* triangles) {
  std::int32_t rows[3][lane_count];
  for (std::size_t i = 0; i < lane_count; ++i) {
    const std::int32_t* corners = in.corners + 3 * static_cast<std::ptrdiff_t>(triangles[i]);
    for (std::size_t k = 0; k < 3; ++k) rows[k][i] = corners[k];
  }
  LaneVector p;
  gather(out.p0.t0, in.x_t0, in.stride_t0, rows[0]);
  gather(out.p0.t1, in.x_t1, in.stride_t1, rows[0]);
  gather(p, in.x_t0, in.stride_t0, rows[1]);
  subtract(out.e1.t0, p, out.p0.t0);
  gather(p, in.x_t1, in.stride_t1, rows[1]);
  subtract(out.e1.t1, p, out.p0.t1);
  gather(p, in.x_t0, in.stride_t0, rows[2]);
  subtract(out.e2.t0, p, out.p0.t0);
  gather(p, in.x_t1, in.stride_t1, rows[2]);
  subtract(out.e2.t1, p, out.p0.t1);
}

// The coefficients of N, the middle one times 2.
struct LaneNormal {
  LaneVector b0, b1, b2;
};

ASSAY_INLINE void normal(LaneNormal& out, const LaneTriangle& triangle) {
  const LaneMotion &e1 = triangle.e1, &e2 = triangle.e2;
  LaneVector a, b;
  cross(out.b0, e1.t0, e2.t0);
  cross(out.b2, e1.t1, e2.t1);
  cross(a, e1.t0, e2.t1);
  cross(b, e1.t1, e2.t0);
  out.b1 = {a.x + b.x, a.y + b.y, a.z + b.z};
}

ASSAY_INLINE void cubic(LaneCubic& h, const LaneMotion& w, const LaneNormal& n) {
  Lanes a, b;
  dot(h.b0, w.t0, n.b0);
  dot(a, w.t0, n.b1);
  dot(b, w.t1, n.b0);
  h.b1 = a + b;
  dot(a, w.t0, n.b2);
  dot(b, w.t1, n.b1);
  h.b2 = a + b;
  dot(h.b3, w.t1, n.b2);
}

ASSAY_INLINE void range(Lanes& least, Lanes& greatest, const LaneCubic& h) {
  least = greatest = h.b0;
  lesser(least, h.b1);
  greater(greatest, h.b1);
  lesser(least, h.b2);
  greater(greatest, h.b2);
  lesser(least, h.b3);
  greater(greatest, h.b3);
}

// Writes the sign of each lane. REQUIRES that at most one of the three masks is true in a lane.
ASSAY_INLINE void write(std::int8_t* signs, const Mask& positive, const Mask& negative,
                        const Mask& zero) {
  const Mask sign = lane_open + positive + 3 * negative + 2 * zero;
  for (std::size_t i = 0; i < lane_count; ++i) signs[i] = static_cast<std::int8_t>(sign[i]);
}

ASSAY_INLINE void point_group(const LaneInput& in, const std::int32_t* triangles,
                              std::int8_t* signs) {
  LaneTriangle t;
  load(t, in, triangles);
  LaneNormal n;
  normal(n, t);
  LaneMotion w;
  subtract(w.t0, t.p0.t0, in.q0_t0);
  subtract(w.t1, t.p0.t1, in.q0_t1);
  LaneCubic h;
  cubic(h, w, n);
  Lanes least, greatest, low = h.b0, high = h.b0;
  range(least, greatest, h);
  lesser(low, h.b3);
  greater(high, h.b3);
  const Lanes bound = all(in.cubic_error), minus = all(-in.cubic_error);
  write(signs, least > bound, greatest < minus, (low < minus) & (high > bound));
}

struct LaneLine {
  LaneTriangle triangle;
  LaneMotion w;  // p0 - q0
  LaneCubic h0, h1;
};

ASSAY_INLINE void cubics(LaneLine& line, const LaneInput& in, const std::int32_t* triangles) {
  load(line.triangle, in, triangles);
  LaneNormal n;
  normal(n, line.triangle);
  subtract(line.w.t0, line.triangle.p0.t0, in.q0_t0);
  subtract(line.w.t1, line.triangle.p0.t1, in.q0_t1);
  cubic(line.h0, line.w, n);
  LaneMotion w;
  subtract(w.t0, line.triangle.p0.t0, in.q1_t0);
  subtract(w.t1, line.triangle.p0.t1, in.q1_t1);
  cubic(line.h1, w, n);
}

ASSAY_INLINE void two_cubics_group(const LaneInput& in, const std::int32_t* triangles,
                                   std::int8_t* signs) {
  LaneLine line;
  cubics(line, in, triangles);
  Lanes least0, greatest0, least1, greatest1;
  range(least0, greatest0, line.h0);
  range(least1, greatest1, line.h1);
  lesser(least0, least1);
  greater(greatest0, greatest1);
  write(signs, least0 > all(in.cubic_error), greatest0 < all(-in.cubic_error), Mask{});
}

ASSAY_INLINE void middle_group(const LaneInput& in, const std::int32_t* triangles,
                               std::int8_t* signs) {
  LaneLine line;
  cubics(line, in, triangles);
  const LaneCubic &h0 = line.h0, &h1 = line.h1;
  const Lanes d0 = h1.b0 - h0.b0, d1 = h1.b1 - h0.b1, d2 = h1.b2 - h0.b2, d3 = h1.b3 - h0.b3;
  Lanes s_least = all(1), s_greatest = {};  // the range of s over the step and the corners
  Lanes end_least = {}, end_greatest = {};  // the range of the corners' values at t=0 and t=1
  for (int corner = 0; corner < 3; ++corner) {
    LaneMotion w = line.w;
    if (corner > 0) {
      // p - q0 is computed from p itself, because (p1-p0) + (p0-q0) would be rounded twice.
      std::int32_t rows[lane_count];
      for (std::size_t i = 0; i < lane_count; ++i) {
        rows[i] = in.corners[3 * static_cast<std::ptrdiff_t>(triangles[i]) + corner];
      }
      LaneVector p;
      gather(p, in.x_t0, in.stride_t0, rows);
      subtract(w.t0, p, in.q0_t0);
      gather(p, in.x_t1, in.stride_t1, rows);
      subtract(w.t1, p, in.q0_t1);
    }
    Lanes s0, s1, s2, mixed;
    dot(s0, w.t0, in.d_t0);
    dot(s1, w.t0, in.d_t1);
    dot(mixed, w.t1, in.d_t0);
    dot(s2, w.t1, in.d_t1);
    s0 = s0 * in.length2_reciprocals[0];
    s1 = (s1 + mixed) * in.length2_reciprocals[1];
    s2 = s2 * in.length2_reciprocals[2];
    lesser(s_least, s0);
    greater(s_greatest, s0);
    lesser(s_least, s1);
    greater(s_greatest, s1);
    lesser(s_least, s2);
    greater(s_greatest, s2);
    clamp_to_unit(s0);
    clamp_to_unit(s2);
    const Lanes at_start = h0.b0 + s0 * d0, at_end = h0.b3 + s2 * d3;
    if (corner == 0) end_least = end_greatest = at_start;
    lesser(end_least, at_start);
    greater(end_greatest, at_start);
    lesser(end_least, at_end);
    greater(end_greatest, at_end);
  }
  s_least = s_least - in.axial_error;
  s_greatest = s_greatest + in.axial_error;
  clamp_to_unit(s_greatest);
  clamp_to_unit(s_least);
  Lanes least, greatest, least2, greatest2;
  range(least, greatest,
        {h0.b0 + s_least * d0, h0.b1 + s_least * d1, h0.b2 + s_least * d2, h0.b3 + s_least * d3});
  range(least2, greatest2,
        {h0.b0 + s_greatest * d0, h0.b1 + s_greatest * d1, h0.b2 + s_greatest * d2,
         h0.b3 + s_greatest * d3});
  lesser(least, least2);
  greater(greatest, greatest2);
  write(signs, least > all(in.value_error), greatest < all(-in.value_error),
        (end_least < all(-in.end_error)) & (end_greatest > all(in.end_error)));
}

typedef void (*Group)(const LaneInput&, const std::int32_t*, std::int8_t*);

template <Group group>
void kernel(const LaneInput& input, const std::int32_t* triangles, std::size_t count,
            std::int8_t* signs) {
  std::size_t i = 0;
  for (; i + lane_count <= count; i += lane_count) group(input, triangles + i, signs + i);
  if (i == count) return;
  // The last triangles do not fill the lanes, so the last one is repeated.
  std::int32_t rest[lane_count];
  std::int8_t rest_signs[lane_count];
  for (std::size_t k = 0; k < lane_count; ++k) {
    rest[k] = triangles[i + k < count ? i + k : count - 1];
  }
  group(input, rest, rest_signs);
  for (std::size_t k = 0; i + k < count; ++k) signs[i + k] = rest_signs[k];
}

constexpr LaneKernels kernels_of_this_file = {lane_count, kernel<point_group>,
                                              kernel<two_cubics_group>, kernel<middle_group>};

}  // namespace
}  // namespace assay::detector::view_kernel
