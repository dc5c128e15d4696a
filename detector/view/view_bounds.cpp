// u = 2^-53. All differences of coordinates k that a lane computes are at most E_k (edges), W_k
// (p - q, both ends of a line) or D_k (q1 - q0) in size, computed ones too: these are computed
// from the least and greatest coordinate, and rounding keeps order. Each is off by at most u times
// that. With S = W_x E_y E_z + W_y E_z E_x + W_z E_x E_y, by the steps of bernstein.h:
//   N        b0, b2: at most 2 E E, off by 8u E E; b1, twice the coefficient, is a sum of two:
//            16u E E and a rounding of at most 4 E E: 20u E E
//   w . b0   terms W 8u EE + 2 EE u W + 2u W EE = 12u; two sums of at most 2 S: 16u S
//   w . b1   terms W 20u EE + 4 EE u W + 4u W EE = 28u; two sums of at most 4 S: 36u S
//   h        ends: 16u S, size 2 S. Middle ones, times 3: 36u S + 16u S and a sum of at most 6 S
//            rounded: 58u S, size 6 S.            cubic_error = 64u S covers all four
//   value    b0 + s (b1 - b0) at a given s of [0,1]: the mean of two coefficients, 58u S;
//            difference at most 12 S, product at most 12 S, sum at most 6 S, each rounded: 30u S.
//            Together 88u S.                       value_error = 112u S
// The slack covers second-order terms and the rounding of S and of the products here.
//
// s: with G = sum of W_k D_k and L = sum of D_k^2, a coefficient a of (p-q0).d is off by 6u G and
// one of d.d, l >= l_min > 0, by 6u L (bernstein.h; the middle ones are both taken times 2). |a| <=
// G, so a/l is off by 6u G / l_min + 6u G L / l_min^2 to first order; the reciprocal and the
// product are rounded: 2u G / l_min. axial_error = (16u + 12u L / l_min) G / l_min, as long as
// L / l_min <= 2^40 (where second-order terms are negligible) and with 2^-1000 for underflow;
// else s may be anything in [0,1], and axial_error = 2 says so.
//
// At t=0 and t=1 the value at a computed s is off by value_error and |b1 - b0| <= 4 S times the
// error of s: end_error = 112u S + 5 S axial_error.
#include "detector/view/view_bounds.h"

#include <cmath>

#include "detector/bernstein/bernstein.h"
#include "detector/mesh/topology.h"

namespace assay::detector {
namespace {

struct Box {
  Point lo, hi;
};

// Several boxes in turn: one alone would wait for each comparison before the next.
Box box_around(std::span<const std::int32_t> vertices, const PositionsView& x) {
  constexpr std::size_t chains = 4;
  const auto row = [&, data = x.data(), stride = x.outerStride()](std::size_t i) {
    return data + stride * vertices[i];
  };
  const double* const first = row(0);
  std::array<Box, chains> boxes;
  boxes.fill({{first[0], first[1], first[2]}, {first[0], first[1], first[2]}});
  const auto include = [](Box& box, const double* p) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = p[k] < box.lo[k] ? p[k] : box.lo[k];
      box.hi[k] = p[k] > box.hi[k] ? p[k] : box.hi[k];
    }
  };
  std::size_t i = 0;
  for (; i + chains <= vertices.size(); i += chains) {
    for (std::size_t c = 0; c < chains; ++c) include(boxes[c], row(i + c));
  }
  for (; i < vertices.size(); ++i) include(boxes[0], row(i));
  for (std::size_t c = 1; c < chains; ++c) {
    include(boxes[0], boxes[c].lo.data());
    include(boxes[0], boxes[c].hi.data());
  }
  return boxes[0];
}

// The sizes of edges and of p - q over one end of the step.
void grow(Vector& edge, Vector& reach, const Box& box, const Point& q0, const Point& q1) {
  for (std::size_t k = 0; k < 3; ++k) {
    edge[k] = std::max(edge[k], box.hi[k] - box.lo[k]);
    for (const Point* q : {&q0, &q1}) {
      reach[k] = std::max({reach[k], std::abs(box.hi[k] - (*q)[k]), std::abs(box.lo[k] - (*q)[k])});
    }
  }
}

void make_axial(LaneInput& input, const Vector& reach, double scale) {
  const MovingVector d = {{input.d_t0[0], input.d_t0[1], input.d_t0[2]},
                          {input.d_t1[0], input.d_t1[1], input.d_t1[2]}};
  Vector line = {0, 0, 0};
  grow(line, d);
  const Quadratic length2 = dot(d, d);
  const double least = *std::min_element(length2.begin(), length2.end());
  const double along = dot(reach, line), length2_scale = dot(line, line);
  input.axial_error = 2;
  for (double& reciprocal : input.length2_reciprocals) reciprocal = 0;
  if (in_range(line) && least > 0 && length2_scale <= 0x1p40 * least) {
    input.length2_reciprocals[0] = 1 / length2[0];
    input.length2_reciprocals[1] = 0.5 / length2[1];
    input.length2_reciprocals[2] = 1 / length2[2];
    input.axial_error =
        (16 + 12 * (length2_scale / least)) * unit_roundoff * (along / least) + 0x1p-1000;
  }
  input.end_error = input.value_error + 5 * scale * input.axial_error;
}

}  // namespace

bool make_lane_input(std::span<const std::int32_t> vertices, const PositionsView& x_t0,
                     const PositionsView& x_t1, const ViewPrimitive& primitive, LaneInput& input) {
  input.x_t0 = x_t0.data();
  input.x_t1 = x_t1.data();
  input.stride_t0 = x_t0.outerStride();
  input.stride_t1 = x_t1.outerStride();
  const MovingVector d = difference(primitive.q1, primitive.q0);
  for (std::size_t k = 0; k < 3; ++k) {
    input.q0_t0[k] = primitive.q0.t0[k];
    input.q0_t1[k] = primitive.q0.t1[k];
    input.q1_t0[k] = primitive.q1.t0[k];
    input.q1_t1[k] = primitive.q1.t1[k];
    input.d_t0[k] = d.t0[k];
    input.d_t1[k] = d.t1[k];
  }
  Vector edge = {0, 0, 0}, reach = {0, 0, 0};
  grow(edge, reach, box_around(vertices, x_t0), primitive.q0.t0, primitive.q1.t0);
  grow(edge, reach, box_around(vertices, x_t1), primitive.q0.t1, primitive.q1.t1);
  if (!in_range(edge) || !in_range(reach)) return false;
  const double scale =
      reach[0] * edge[1] * edge[2] + reach[1] * edge[2] * edge[0] + reach[2] * edge[0] * edge[1];
  input.cubic_error = lane_cubic_units * unit_roundoff * scale;
  input.value_error = lane_value_units * unit_roundoff * scale;
  make_axial(input, reach, scale);
  return true;
}

}  // namespace assay::detector
