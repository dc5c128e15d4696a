// Wrong view tests.
//
// Views from a point: f = (p0 - q).N is a cubic in t. Every fault here ignores a part of f (L2).

#include "detector/exact/bernstein.h"
#include "detector/geometry/winding.h"
#include "properties/faults/planting.h"
#include "properties/faults/view_polynomials.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace

namespace {

ViewSign linear_in_time(const ViewPolynomials& view) {
  return strict_sign(linear_between_ends(view.h0));
}

ViewSign frozen_normal(const ViewPolynomials& view) {
  return strict_sign(dot(view.to_corner, at_start(view.normal)));
}

ViewSign frozen_corner(const ViewPolynomials& view) {
  return strict_sign(dot(at_start(view.to_corner), view.normal));
}

ViewSign linear_normal(const ViewPolynomials& view) {
  return strict_sign(dot(view.to_corner, linear_between_ends(view.normal)));
}

ViewSign without_cubic_term(const ViewPolynomials& view) {
  const Polynomial& f = view.h0;
  if (f.degree() < 3) return strict_sign(f);
  const Polynomial t = Polynomial::linear(0, 1);
  return strict_sign(f - Polynomial::constant(f[3]) * t * t * t);
}

// Says positive if f >= 0 all along. Between two zeros f keeps the sign of its value half way.
ViewSign touching_zero_is_positive(const ViewPolynomials& view) {
  const Polynomial& f = view.h0;
  if (f.is_zero()) return ViewSign::positive;
  double since = 0;
  const auto is_negative_at = [&](double t) { return f.sign_at(Dyadic::of(t)) < 0; };
  for (const auto& root : detector::roots_in_unit_interval(f)) {
    if (is_negative_at((since + root.enclosure().lo) / 2)) return strict_sign(f);
    since = root.enclosure().hi;
  }
  return is_negative_at((since + 1) / 2) || is_negative_at(0) || is_negative_at(1)
             ? strict_sign(f)
             : ViewSign::positive;
}

ViewSign sign_of_coefficients(const Cubic& f, int depth) {
  const auto [least, greatest] = std::ranges::minmax_element(f);
  if (*least > 0) return ViewSign::positive;
  if (*greatest < 0) return ViewSign::negative;
  if (depth == 10) return ViewSign::zero;
  Cubic left, right;
  detector::halve(f, left, right);
  return common_sign(
      {sign_of_coefficients(left, depth + 1), sign_of_coefficients(right, depth + 1)});
}

// Computes in doubles without bounds, so a value that is 0, or just below, may come out above 0.
ViewSign in_plain_doubles(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  using detector::difference;
  const auto normal =
      cross(difference(triangle[1], triangle[0]), difference(triangle[2], triangle[0]));
  const auto f = triple_product(difference(triangle[0], primitive.q0), normal);
  return sign_of_coefficients(f, 0);
}

template <ViewSign merged_sign>
ViewSign zero_merged(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  const ViewSign right = right_sign(triangle, primitive);
  return right == ViewSign::zero ? merged_sign : right;
}

// Says that a triangle without area is positive, as if it could not be seen from behind because it
// has no normal.
ViewSign zero_area_is_positive(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  const auto vanishes = [](const PolynomialVector& n) {
    return n[0].is_zero() && n[1].is_zero() && n[2].is_zero();
  };
  const auto normal = view_polynomials(triangle, primitive).normal;
  const PolynomialVector end = {at_end(normal[0]), at_end(normal[1]), at_end(normal[2])};
  return vanishes(at_start(normal)) || vanishes(end) ? ViewSign::positive
                                                     : right_sign(triangle, primitive);
}

// Lets each triangle take the one of two views that suits it (L10).
ViewSign positive_from_either_place(const MovingTriangle& triangle,
                                    const ViewPrimitive& primitive) {
  const auto q0 = still(Sample::start, primitive.q0), q1 = still(Sample::end, primitive.q0);
  const ViewSign first = right_sign(triangle, {q0, q0});
  return first == ViewSign::positive ? first : right_sign(triangle, {q1, q1});
}

template <Sample place>
ViewSign from_frozen_primitive(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return right_sign(triangle, {still(place, primitive.q0), still(place, primitive.q1)});
}

}  // namespace

std::vector<Fault> view_point_faults() {
  return {
      {wrong<Signs<sampled<Sample::start>>>, "view/at-start-only", "L2", "M_start", 4,
       "the sign at t=0 is used for the whole step"},
      {wrong<Signs<sampled<Sample::middle>>>, "view/in-the-middle-only", "L2", "M_mid", 4,
       "the sign at t=1/2 is used for the whole step"},
      {wrong<Signs<sampled<Sample::end>>>, "view/at-end-only", "L2", "M_end", 4,
       "the sign at t=1 is used for the whole step"},
      {wrong<Signs<sampled<Sample::start, Sample::end>>>, "view/at-ends-only", "L2",
       "A4_endpoints_only", 4, "if the signs at t=0 and t=1 agree, they are used throughout"},
      {wrong<Signs<linear_in_time>>, "view/linear-in-time", "L2", "A4_endpoints_only", 4,
       "f is linear between its values at t=0 and t=1"},
      {wrong<Signs<sampled<Sample::start, Sample::middle, Sample::end>>>, "view/three-samples",
       "L2", "A4b_three_samples", 4, "if the signs at t=0, 1/2, 1 agree, they are used throughout"},
      {wrong<Signs<frozen_normal>>, "view/frozen-normal", "L2", "M_frozenN", 4,
       "the normal of t=0 is used for the whole step"},
      {wrong<Signs<frozen_corner>>, "view/frozen-corner", "L2", "M_frozenV", 4,
       "p - q of t=0 is used for the whole step, but the normal moves"},
      {wrong<Signs<linear_normal>>, "view/linear-normal", "L2", "M_linN", 4,
       "the normal is linear between t=0 and t=1"},
      {wrong<Signs<without_cubic_term>>, "view/cubic-term-dropped", "L2", "M_dropcubic", 4,
       "the term t^3 of f is left out"},
      {wrong<Signs<touching_zero_is_positive>>, "view/touching-zero-is-positive", "L2",
       "A3b_nonstrict_touch", 7, "f >= 0 is enough for V+, so f may touch zero"},
      {wrong<Signs<in_plain_doubles>>, "view/plain-doubles", "L2", "F_rounded_to_positive", 4,
       "doubles without error bounds: a value near 0 may be promoted to V+"},
      {wrong<Signs<zero_merged<ViewSign::positive>>>, "view/zero-is-positive", "L3", "M_pZtoP", 4,
       "V0 is merged into V+"},
      {wrong<Signs<zero_merged<ViewSign::negative>>>, "view/zero-is-negative", "L3", "M_pZtoM", 4,
       "V0 is merged into V-"},
      {wrong<Signs<zero_area_is_positive>>, "view/zero-area-is-positive", "L12", "A3_nonstrict_end",
       7, "a triangle that has no area at t=0 or t=1 goes into V+"},
      {wrong<Signs<positive_from_either_place>>, "view/positive-from-either-place", "L10",
       "F_either_place", 4, "to be positive from the primitive's place at t=0 or t=1 is enough"},
      {wrong<Signs<from_frozen_primitive<Sample::end>>>, "view/primitive-at-its-end", "L5",
       "F_primitive_at_its_end", 6,
       "signs are seen from the primitive's place at t=1, but the winding number is that at t=0"},
      {wrong<Signs<from_frozen_primitive<Sample::start>>>, "view/primitive-stays", "L3", "", 0,
       "a moving primitive stays at its place of t=0 for the whole step", with_points,
       FaultStatus::equivalent,
       "a fixed place gives one continuous field (L10) with its own winding number. In an embedded "
       "surface, the next step's place has winding number 1 if all triangles are positive"},
  };
}

// From a line: every corner needs its own nearest point at every time (L1), and all triangles of a
// component need one field of view rays (L10).

namespace {

ViewSign one_corner(const ViewPolynomials& view) { return sign_of(pieces_of_corner(view, 0)); }

// Uses the region of corner 0 at t=0 for everything: one end of the line, or the foot on its axis.
ViewSign region_of_first_corner(const ViewPolynomials& view) {
  const auto pieces = pieces_of_corner(view, 0);
  if (pieces.g0.sign_at_zero() <= 0) return strict_sign(pieces.h0);
  if (pieces.g1.sign_at_zero() >= 0) return strict_sign(pieces.h1);
  return strict_sign(pieces.middle);
}

// Uses the point of the line that is nearest to corner 0 at t=0 for all corners and the whole
// step.
ViewSign frozen_nearest_point(const ViewPolynomials& view) {
  if (view.g0[0].sign_at_zero() <= 0) return strict_sign(view.h0);
  if (view.g1[0].sign_at_zero() >= 0) return strict_sign(view.h1);
  const Polynomial along = at_start(view.g0[0]), length2 = at_start(view.length2);
  return strict_sign((length2 - along) * view.h0 + along * view.h1);
}

// Looks at the centroid alone, with its own nearest point. All values are multiplied by 3.
ViewSign of_centroid(const ViewPolynomials& view) {
  const Polynomial g0 = view.g0[0] + view.g0[1] + view.g0[2];
  const Polynomial g1 = view.g1[0] + view.g1[1] + view.g1[2];
  const Polynomial three = Polynomial::constant(3);
  return sign_of({view.h0, view.h1, three * view.h0 * view.length2 - g0 * view.d_normal, g0, g1});
}

ViewSign positive_from_either_end(const ViewPolynomials& view) {
  const ViewSign first = strict_sign(view.h0);
  return first == ViewSign::positive ? first : strict_sign(view.h1);
}

// Looks from the end of the line that is nearer to corner 0 at t=0.
ViewSign from_nearer_end(const ViewPolynomials& view) {
  const bool second = (view.g0[0] + view.g1[0]).sign_at_zero() > 0;
  return strict_sign(second ? view.h1 : view.h0);
}

ViewPrimitive midpoint(const ViewPrimitive& line) {
  ViewPrimitive view;
  for (std::size_t k = 0; k < 3; ++k) {
    view.q0.t0[k] = 0.5 * line.q0.t0[k] + 0.5 * line.q1.t0[k];
    view.q0.t1[k] = 0.5 * line.q0.t1[k] + 0.5 * line.q1.t1[k];
  }
  view.q1 = view.q0;
  return view;
}

ViewSign from_midpoint(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return right_sign(triangle, midpoint(primitive));
}

// Asks for the winding number at the midpoint, from which the view is taken. The number at an end
// would say nothing.
struct FreeFromMidpoint : ReleaseRule {
  bool is_free(const GivenStep& step, const StepMarks& marks, StepCost&,
               std::size_t c) const override {
    const auto& triangles = step.component(c).triangles;
    for (const auto t : triangles) {
      if (marks.signs[at(t)] != ViewSign::positive) return false;
    }
    return detector::winding_number(step.surface.all(), triangles, step.motion.vertices_t0,
                                    midpoint(marks.primitives[c]).q0.t0) == 1;
  }
};

Fault midpoint_with_its_winding(Fault fault) {
  fault.stages = [](const Options& options) {
    auto stages = with<Signs<from_midpoint>>(options);
    stages.release = std::make_shared<FreeFromMidpoint>();
    return stages;
  };
  return fault;
}

ViewSign from_first_end(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return right_sign(triangle, {primitive.q0, primitive.q0});
}

ViewSign with_swapped_ends(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return right_sign(triangle, {primitive.q1, primitive.q0});
}

// Uses the middle piece everywhere, as if the line were its whole axis.
ViewSign from_unclamped_axis(const ViewPolynomials& view) {
  return common_sign({strict_sign(pieces_of_corner(view, 0).middle),
                      strict_sign(pieces_of_corner(view, 1).middle),
                      strict_sign(pieces_of_corner(view, 2).middle)});
}

}  // namespace

std::vector<Fault> view_line_faults() {
  return {
      {wrong<Signs<one_corner>>, "view-line/one-corner", "L1", "B1_one_vertex_own_nearest", 7,
       "only corner 0 is seen, from its own nearest point", with_lines},
      {wrong<Signs<region_of_first_corner>>, "view-line/region-of-first-corner", "L1",
       "B2_region_of_vertex0_at_start", 7,
       "the region of corner 0 at t=0 is used for all corners and the whole step", with_lines},
      {wrong<Signs<frozen_nearest_point>>, "view-line/frozen-nearest-point", "L10",
       "B3_nearest_point_frozen", 7,
       "corner 0's nearest point at t=0 is used for all corners and the whole step", with_lines},
      {wrong<Signs<of_centroid>>, "view-line/centroid", "L1", "M_Lcentroid", 6,
       "only the centroid is seen, from its own nearest point", with_lines},
      {wrong<Signs<positive_from_either_end>>, "view-line/positive-from-either-end", "L10",
       "M_Leither", 6, "a triangle is positive if it is positive from q0 or from q1", with_lines},
      {wrong<Signs<from_nearer_end>>, "view-line/nearer-end", "L10", "F_line_nearer_end", 6,
       "a triangle is seen from the end that is nearer to its corner 0 at t=0", with_lines},
      {wrong<Signs<sampled<Sample::start>>>, "view-line/at-start-only", "L2", "M_Lstartall", 4,
       "the sign at t=0 is used for the whole step", with_lines},
      {wrong<Signs<sampled<Sample::start, Sample::end>>>, "view-line/at-ends-only", "L2",
       "M_Lendsall", 5, "if the signs at t=0 and t=1 agree, they are used throughout", with_lines},
      {wrong<Signs<from_midpoint>>, "view-line/midpoint-with-winding-of-an-end", "L5",
       "F_line_midpoint_winding", 6,
       "signs are seen from the line's midpoint, but the winding number is that at q0", with_lines},
      {wrong<Signs<from_first_end>>, "view-line/from-first-end", "L10", "", 0,
       "triangles are seen from q0 only", with_lines, FaultStatus::equivalent,
       "the view from one point is one continuous field"},
      midpoint_with_its_winding(
          Fault{wrong<Signs<from_midpoint>>, "view-line/from-midpoint", "L10", "", 0,
                "triangles are seen from the midpoint only, with its winding number", with_lines,
                FaultStatus::equivalent, "the view from one point is one continuous field"}),
      {wrong<Signs<from_unclamped_axis>>, "view-line/unclamped-axis", "L10", "", 0,
       "triangles are seen from the whole axis, not from the segment", with_lines,
       FaultStatus::equivalent, "the view from the axis is one continuous field"},
      {wrong<Signs<with_swapped_ends>>, "view-line/swapped-ends", "L10", "", 0,
       "q0 and q1 are exchanged", with_lines, FaultStatus::equivalent,
       "the field does not depend on the direction of the segment"},
  };
}

}  // namespace assay::properties
