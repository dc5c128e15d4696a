// Exact view signs of triangles over a step, for view-point and view-line (L1 and L2,
// detector/LAWS.md), and the set K of the pairs of triangles that view signs do not rule out.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

using MovingTriangle = std::array<detector::MovingPoint, 3>;

// Returns the view sign of a triangle, or nothing if intervals cannot prove it. Uses interval
// arithmetic on pieces of the step. For a view-point it takes 0.2 us over a small motion and 2 us
// over a large motion; for a segment it takes 7 us.
// Notation, with N = (p1 - p0) x (p2 - p0) and d = q1 - q0:
//   h0 = (p - q0).N, h1 = (p - q1).N (the same for every p in the triangle's plane),
//   g0 = (p - q0).d, g1 = (p - q1).d = g0 - |d|^2, hm = h1 g0 - h0 g1 = h0 |d|^2 - g0 (d.N).
// The view function of p is h0 if g0 <= 0, h1 if g1 >= 0, and hm / |d|^2 otherwise.
std::optional<detector::ViewSign> interval_view_sign(const MovingTriangle& triangle,
                                                     const detector::ViewPrimitive& primitive);

// Returns the view sign of a triangle by exact polynomials and the algebraic kernel. 0.2 to 0.4 ms;
// up to 0.1 s when the exponents of the coordinates spread over all doubles.
// The triangle is positive or negative over the step exactly when the view function of no vertex
// is ever zero and the three signs at t=0 agree, because the view function of a vertex is
// continuous.
detector::ViewSign exact_view_sign(const MovingTriangle& triangle,
                                   const detector::ViewPrimitive& primitive);

// Returns the view sign. `positive`: (x - n(x)).N > 0 at every point x of the triangle and every t
// in [0,1], where n(x) is the primitive's point nearest to x and N the triangle's normal.
// `negative`: (x - n(x)).N < 0 at all of them. `zero`: neither. The primitive may be a point, a
// fixed segment, or a segment whose end points move differently (hm is then a quintic).
detector::ViewSign view_sign(const MovingTriangle& triangle,
                             const detector::ViewPrimitive& primitive);

// Returns the view sign of each triangle. REQUIRES one primitive for all triangles, or one
// primitive for each triangle.
std::vector<detector::ViewSign> view_signs(const detector::SteppedMesh& motion,
                                           const detector::TrianglesView& triangles,
                                           std::span<const detector::ViewPrimitive> primitives);

// K, the pairs among which the first contact is found (L3 and L10, detector/LAWS.md).
//
// K = (V+,V-) u (U,V0) u (U,Vv), where U is all triangles. If there are groups, K also holds every
// pair of triangles of two different groups (L10). So a pair is in K when its signs are opposite,
// when a sign is zero, when a triangle is in Vv, or when its triangles are of two different groups.
// Triangles that share a vertex or an edge are pairs like all others.
class Candidates {
 public:
  // Each list has one element for each triangle. `violated` is 1 for a triangle of Vv (dirty, or
  // touched by a ghost), else 0; it may be empty if Vv is empty. `groups` holds components; it
  // may be empty if all triangles are of one group.
  Candidates(std::vector<detector::ViewSign> signs, std::vector<std::uint8_t> violated,
             std::vector<std::int32_t> groups = {});

  bool holds(const detector::TrianglePair& pair) const;

 private:
  std::vector<detector::ViewSign> signs_;
  std::vector<std::uint8_t> violated_;
  std::vector<std::int32_t> groups_;
};

// Returns whether L3 holds: some pair of `pairs` with the least time is in `candidates`. Returns
// true if there are no pairs.
bool holds_a_first_contact(const std::vector<detector::PairContact>& pairs,
                           const Candidates& candidates);

}  // namespace assay::oracle
