// Error bounds of the lanes, in the notation of bernstein.h. Along axis k, an edge is at most E_k
// in size, p - q at most W_k for both ends q of a line, and d = q1 - q0 at most D_k. This also
// holds for the differences that a lane computes, because E_k, W_k and D_k are computed from the
// least and the greatest coordinate, and rounding keeps order.
//   T = W_x E_y E_z + W_y E_z E_x + W_z E_x E_y
//   G = W_x D_x + W_y D_y + W_z D_z
//   L = D_x^2 + D_y^2 + D_z^2
// N is the normal with Bernstein coefficients b0, b1, b2. A lane computes 2 b1 in place of b1, and
// the two middle coefficients of h multiplied by 3.
//
//   quantity         | operations                            | error in u               | size
//   b0, b2           | minor of two edges                    | 8 EE                     | 2 EE
//   2 b1             | minor + minor                         | 8 + 8 + 4 = 20 EE        | 4 EE
//   w b0             | an entry of p - q times b0            | 8 + 2 + 2 = 12 WEE       | 2 WEE
//   w . b0           | three w b0, two sums                  | 12 + 2 + 2 = 16 T        | 2 T
//   w (2 b1)         | an entry of p - q times 2 b1          | 20 + 4 + 4 = 28 WEE      | 4 WEE
//   w . (2 b1)       | three w (2 b1), two sums              | 28 + 4 + 4 = 36 T        | 4 T
//   h, at the ends   | w . b0 or w . b2                      | 16 T                     | 2 T
//   3 h, middle      | w . (2 b1) + w . b0 or + w . b2       | 36 + 16 + 6 = 58 T       | 6 T
//   value            | h0 + s (h1 - h0), s given in [0,1]    | 58 + 12 + 12 + 6 = 88 T  | 6 T
//
// The value is a mean of h0 and h1, so it inherits their error of 58 T; h1 - h0 and its product
// with s are at most 12 T in size. lane_cubic_units = 64 covers h and 3 h, and lane_value_units =
// 112 covers the value. The slack covers errors of second order, and the rounding of T and of the
// products here.
//
// The ratio s = a / l of a coefficient a of (p-q0).d and the same coefficient l of d.d, with l >=
// l_min > 0 (both middle coefficients are multiplied by 2):
//
//   quantity      | operations                      | error in u                     | size
//   a             | x . y, middle                   | 6 G                            | G
//   l             | x . y, middle                   | 6 L                            | L
//   a / l         | the errors of a and of l        | 6 G / l_min + 6 G L / l_min^2  | G / l_min
//   a * (1 / l)   | a reciprocal and a product      | as before + 2 G / l_min        | G / l_min
//
// The errors add up to u (8 + 6 L / l_min) G / l_min. axial_error is twice that, plus 2^-1000 for
// underflow. It holds as long as L / l_min <= 2^40, because then errors of second order are
// negligible. If L / l_min > 2^40, axial_error is 2, which means that s can be anything in [0,1].
//
// At t=0 and t=1 the value is computed with a computed s. It is off by value_error, plus the error
// of s multiplied by |h1 - h0| <= 4 T: end_error = value_error + 5 T axial_error.
#include <cmath>

#include "detector/exact/bernstein.h"
#include "detector/mesh/for_all.h"
#include "detector/mesh/topology.h"
#include "detector/view/view_signs.h"

namespace assay::detector {
namespace {

struct Box {
  Point lo, hi;
};

void include(Box& box, const double* p) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = p[k] < box.lo[k] ? p[k] : box.lo[k];
    box.hi[k] = p[k] > box.hi[k] ? p[k] : box.hi[k];
  }
}

void include(Box& box, const Box& other) {
  include(box, other.lo.data());
  include(box, other.hi.data());
}

// Returns the box around the vertices. It grows several boxes in turn, because with one alone each
// comparison would wait for the one before.
Box box_around(std::span<const std::int32_t> vertices, const PositionsView& x) {
  constexpr std::size_t chains = 4;
  const auto row = [&, data = x.data(), stride = x.outerStride()](std::size_t i) {
    return data + stride * vertices[i];
  };
  const double* const first = row(0);
  std::array<Box, chains> boxes;
  boxes.fill({{first[0], first[1], first[2]}, {first[0], first[1], first[2]}});
  std::size_t i = 0;
  for (; i + chains <= vertices.size(); i += chains) {
    for (std::size_t c = 0; c < chains; ++c) include(boxes[c], row(i + c));
  }
  for (; i < vertices.size(); ++i) include(boxes[0], row(i));
  for (std::size_t c = 1; c < chains; ++c) include(boxes[0], boxes[c]);
  return boxes[0];
}

Box box_around(std::span<const std::int32_t> vertices, const PositionsView& x, PacedStop* pace) {
  constexpr std::uint64_t work_of_vertex = 1;
  if (!has_workers(pace)) {
    if (pace) pace->after(work_of_vertex * vertices.size());
    return box_around(vertices, x);
  }
  std::vector<Box> of_lanes(pace->workers()->count(), box_around(vertices.first(1), x));
  for_all_pieces(vertices.size(), piece_of(vertices.size()), work_of_vertex, pace,
                 [&](std::size_t begin, std::size_t end, std::size_t lane) {
                   include(of_lanes[lane], box_around(vertices.subspan(begin, end - begin), x));
                 });
  for (const Box& box : of_lanes) include(of_lanes[0], box);
  return of_lanes[0];
}

// Raises `edge` and `reach` to the sizes of edges and of p - q at one end of the step.
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

bool make_lane_input(std::span<const std::int32_t> vertices, const SteppedMesh& motion,
                     const ViewPrimitive& primitive, LaneInput& input, PacedStop* pace) {
  input.x_t0 = motion.vertices_t0.data();
  input.x_t1 = motion.vertices_t1.data();
  input.stride_t0 = motion.vertices_t0.outerStride();
  input.stride_t1 = motion.vertices_t1.outerStride();
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
  grow(edge, reach, box_around(vertices, motion.vertices_t0, pace), primitive.q0.t0,
       primitive.q1.t0);
  grow(edge, reach, box_around(vertices, motion.vertices_t1, pace), primitive.q0.t1,
       primitive.q1.t1);
  if (!in_range(edge) || !in_range(reach)) return false;
  const double scale =
      reach[0] * edge[1] * edge[2] + reach[1] * edge[2] * edge[0] + reach[2] * edge[0] * edge[1];
  input.cubic_error = lane_cubic_units * unit_roundoff * scale;
  input.value_error = lane_value_units * unit_roundoff * scale;
  make_axial(input, reach, scale);
  return true;
}

}  // namespace assay::detector
