// Wrong view tests from a point. Here f = (p0 - q).N is a cubic in t, and every short cut looks at
// less than all of it (L2).
#include "detector/bernstein/bernstein.h"
#include "detector/geometry/winding.h"
#include "properties/faults/planting.h"
#include "properties/faults/view_polynomials.h"

namespace assay::properties {
namespace {

using detector::MovingTriangle;
using detector::Polynomial;
using detector::ViewPrimitive;
using detector::ViewSign;

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
  const auto is_negative_at = [&](double t) { return f.sign_at(detector::Dyadic::of(t)) < 0; };
  for (const auto& root : detector::roots_in_unit_interval(f)) {
    if (is_negative_at((since + root.enclosure().lo) / 2)) return strict_sign(f);
    since = root.enclosure().hi;
  }
  return is_negative_at((since + 1) / 2) || is_negative_at(0) || is_negative_at(1)
             ? strict_sign(f)
             : ViewSign::positive;
}

ViewSign sign_of_coefficients(const detector::Cubic& f, int depth) {
  const auto [least, greatest] = std::minmax_element(f.begin(), f.end());
  if (*least > 0) return ViewSign::positive;
  if (*greatest < 0) return ViewSign::negative;
  if (depth == 10) return ViewSign::zero;
  detector::Cubic left, right;
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

template <ViewSign merged>
ViewSign zero_merged(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  const ViewSign right = right_sign(triangle, primitive);
  return right == ViewSign::zero ? merged : right;
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

// Each triangle takes the one of two views that suits it (L10).
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
      planted<Signs<sampled<Sample::start>>>(
          "view/at-start-only", "the sign at t=0 is taken for the step's", "L2", "M_start", 4),
      planted<Signs<sampled<Sample::middle>>>(
          "view/in-the-middle-only", "the sign at t=1/2 is taken for the step's", "L2", "M_mid", 4),
      planted<Signs<sampled<Sample::end>>>(
          "view/at-end-only", "the sign at t=1 is taken for the step's", "L2", "M_end", 4),
      planted<Signs<sampled<Sample::start, Sample::end>>>(
          "view/at-ends-only", "equal signs at t=0 and t=1 are taken for the step's", "L2",
          "A4_endpoints_only", 4),
      planted<Signs<linear_in_time>>("view/linear-in-time",
                                     "f runs along the line between its ends", "L2",
                                     "A4_endpoints_only", 4),
      planted<Signs<sampled<Sample::start, Sample::middle, Sample::end>>>(
          "view/three-samples", "equal signs at t=0, 1/2, 1 are taken for the step's", "L2",
          "A4b_three_samples", 4),
      planted<Signs<frozen_normal>>("view/frozen-normal", "the normal stays as it is at t=0", "L2",
                                    "M_frozenN", 4),
      planted<Signs<frozen_corner>>("view/frozen-corner",
                                    "p - q stays as it is at t=0, the normal moves", "L2",
                                    "M_frozenV", 4),
      planted<Signs<linear_normal>>("view/linear-normal",
                                    "the normal runs along the line between its ends", "L2",
                                    "M_linN", 4),
      planted<Signs<without_cubic_term>>("view/cubic-term-dropped", "f without its t^3", "L2",
                                         "M_dropcubic", 4),
      planted<Signs<touching_zero_is_positive>>(
          "view/touching-zero-is-positive", "f >= 0 is enough for V+: touching zero does not count",
          "L2", "A3b_nonstrict_touch", 7),
      planted<Signs<in_plain_doubles>>(
          "view/plain-doubles",
          "doubles without error bounds: a value near 0 may be promoted to V+", "L2",
          "F_rounded_to_positive", 4),
      planted<Signs<zero_merged<ViewSign::positive>>>("view/zero-is-positive",
                                                      "V0 is merged into V+", "L3", "M_pZtoP", 4),
      planted<Signs<zero_merged<ViewSign::negative>>>("view/zero-is-negative",
                                                      "V0 is merged into V-", "L3", "M_pZtoM", 4),
      planted<Signs<zero_area_is_positive>>(
          "view/zero-area-is-positive", "a triangle that has no area at t=0 or t=1 goes into V+",
          "L12", "A3_nonstrict_end", 7),
      planted<Signs<positive_from_either_place>>(
          "view/positive-from-either-place",
          "positive from the moving point's place at t=0, or from that at "
          "t=1",
          "L10", "F_either_place", 4),
      planted<Signs<from_frozen_primitive<Sample::end>>>(
          "view/primitive-at-its-end",
          "seen from the primitive's place at t=1, while the winding number "
          "is that of its place at t=0",
          "L5", "F_primitive_at_its_end", 6),
      unseen<Signs<from_frozen_primitive<Sample::start>>>(
          FaultStatus::equivalent, "view/primitive-stays",
          "a moving primitive is taken where it is at t=0, for the whole step", "L3",
          "any fixed place is one continuous field (L10), and the winding number is taken there; "
          "where "
          "the place at t=1 is trusted in the next step, it has winding number 1 or 0 in an "
          "embedded "
          "surface, and from winding number 0 not everything is positive"),
  };
}

}  // namespace assay::properties
