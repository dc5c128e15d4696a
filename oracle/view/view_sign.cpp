#include "oracle/view/view_sign.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "oracle/parallel_chunks.h"
#include "oracle/processor_state.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/times/algebraic_times.h"

namespace assay::oracle {

detector::ViewSign view_sign(const std::array<detector::MovingPoint, 3>& triangle,
                             const detector::ViewPrimitive& primitive) {
  require_exact_processor_state();
  if (const auto quick = interval_view_sign(triangle, primitive)) return *quick;
  return exact_view_sign(triangle, primitive);
}

std::vector<detector::ViewSign> view_signs(const detector::SteppedMesh& motion,
                                           const detector::TrianglesView& triangles,
                                           std::span<const detector::ViewPrimitive> primitives,
                                           int jobs) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(primitives.size() == 1 || primitives.size() == count);
  std::vector<detector::ViewSign> signs(count);
  constexpr std::size_t triangles_at_once = 256;
  StopGate never({});
  for_each_chunk(count, triangles_at_once, jobs, never,
                 [&](std::size_t begin, std::size_t end, int) {
                   for (std::size_t t = begin; t < end; ++t) {
                     auto corner = [&](int i) {
                       return motion.path(triangles(static_cast<Eigen::Index>(t), i));
                     };
                     signs[t] = view_sign({corner(0), corner(1), corner(2)},
                                          primitives[primitives.size() == 1 ? 0 : t]);
                   }
                 });
  return signs;
}

namespace {

using detector::ViewSign;

struct ViewPolynomials {
  IntegerPolynomial h0, h1;
  std::array<IntegerPolynomial, 3> g0, g1;  // by vertex of the triangle

  ViewPolynomials(const MovingTriangle& p, const detector::ViewPrimitive& q) {
    const std::array<detector::MovingPoint, 5> points = {p[0], p[1], p[2], q.q0, q.q1};
    const IntegerScale scale(points);
    const PolynomialVector normal =
        cross(moving_difference(scale, p[0], p[1]), moving_difference(scale, p[0], p[2]));
    const PolynomialVector d = moving_difference(scale, q.q0, q.q1);
    h0 = dot(moving_difference(scale, q.q0, p[0]), normal);
    h1 = dot(moving_difference(scale, q.q1, p[0]), normal);
    for (int i = 0; i < 3; ++i) {
      g0[i] = dot(moving_difference(scale, q.q0, p[i]), d);
      g1[i] = dot(moving_difference(scale, q.q1, p[i]), d);
    }
  }
  IntegerPolynomial between(int vertex) const { return h1 * g0[vertex] - h0 * g1[vertex]; }
};

int sign_at_start(const ViewPolynomials& v, int vertex) {
  if (sign_at(v.g0[vertex], 0) <= 0) return sign_at(v.h0, 0);
  if (sign_at(v.g1[vertex], 0) >= 0) return sign_at(v.h1, 0);
  return sign_at(v.between(vertex), 0);
}

bool not_positive_somewhere(const IntegerPolynomial& g) {
  return sign_at(g, 0) <= 0 || sign_at(g, 1) <= 0 || AlgebraicTimes({&g, 1}).size() > 0;
}

// Whether h is zero at a time when some g is <= 0.
bool zero_of_end_piece(const IntegerPolynomial& h, std::span<const IntegerPolynomial> gs) {
  if (h.is_zero()) return std::any_of(gs.begin(), gs.end(), not_positive_somewhere);
  const AlgebraicTimes zeros({&h, 1});
  for (int i = 0; i < zeros.size(); ++i) {
    for (const IntegerPolynomial& g : gs) {
      if (zeros.sign(g, i) <= 0) return true;
    }
  }
  return false;
}

// Whether the middle piece is zero at a time when it is active. If hm is identically zero, the
// piece is not active at t=0, because the sign there is known not to be zero. So a time at which
// it becomes active is a boundary of the piece, where the view function is zero by continuity, and
// h0 or h1 with it; the end pieces find that.
bool zero_of_middle_piece(const ViewPolynomials& v, int vertex) {
  const IntegerPolynomial hm = v.between(vertex);
  if (hm.is_zero()) return false;
  const AlgebraicTimes zeros({&hm, 1});
  for (int i = 0; i < zeros.size(); ++i) {
    if (zeros.sign(v.g0[vertex], i) > 0 && zeros.sign(v.g1[vertex], i) < 0) return true;
  }
  return false;
}

}  // namespace

ViewSign exact_view_sign(const MovingTriangle& triangle, const detector::ViewPrimitive& primitive) {
  const ViewPolynomials v(triangle, primitive);
  const int sign = sign_at_start(v, 0);
  if (sign == 0) return ViewSign::zero;
  for (int i = 1; i < 3; ++i) {
    if (sign_at_start(v, i) != sign) return ViewSign::zero;
  }
  const std::array<IntegerPolynomial, 3> minus_g1 = {-v.g1[0], -v.g1[1], -v.g1[2]};
  if (zero_of_end_piece(v.h0, v.g0) || zero_of_end_piece(v.h1, minus_g1)) return ViewSign::zero;
  for (int i = 0; i < 3; ++i) {
    if (zero_of_middle_piece(v, i)) return ViewSign::zero;
  }
  return sign > 0 ? ViewSign::positive : ViewSign::negative;
}

}  // namespace assay::oracle
