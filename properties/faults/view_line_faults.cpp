// Wrong view tests from a line. Every corner needs its own nearest point at every time (L1), and
// all triangles of a component need one field of view rays (L10).
#include "detector/geometry/winding.h"
#include "properties/faults/planting.h"
#include "properties/faults/view_polynomials.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using detector::MovingTriangle;
using detector::Polynomial;
using detector::ViewPrimitive;
using detector::ViewSign;

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
    view.q0.t0[k] = 0.5 * (line.q0.t0[k] + line.q1.t0[k]);
    view.q0.t1[k] = 0.5 * (line.q0.t1[k] + line.q1.t1[k]);
  }
  view.q1 = view.q0;
  return view;
}

ViewSign from_midpoint(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return right_sign(triangle, midpoint(primitive));
}

// Asks for the winding number at the midpoint, from which the view is taken. That of an end would
// say nothing.
struct FreeFromMidpoint : detector::ReleaseRule {
  bool is_free(const detector::GivenStep& step, const detector::StepMarks& marks,
               detector::StepCost&, std::size_t c) const override {
    const auto& triangles = step.component(c).triangles;
    for (const auto t : triangles) {
      if (marks.signs[at(t)] != ViewSign::positive) return false;
    }
    return detector::winding_number(step.surface.all(), triangles, step.motion.vertices_t0,
                                    midpoint(marks.primitives[c]).q0.t0) == 1;
  }
};

Fault midpoint_with_its_winding(Fault fault) {
  fault.stages = [](const detector::Options& options) {
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

template <auto sign>
Fault line(std::string_view name, std::string_view about, std::string_view law,
           std::string_view curated, int vertices) {
  return planted<Signs<sign>>(name, about, law, curated, vertices, with_lines);
}

template <auto sign>
Fault equivalent(std::string_view name, std::string_view about, std::string_view reason) {
  return unseen<Signs<sign>>(FaultStatus::equivalent, name, about, "L10", reason, with_lines);
}

}  // namespace

std::vector<Fault> view_line_faults() {
  return {
      line<one_corner>("view-line/one-corner", "corner 0 alone, with its own nearest point", "L1",
                       "B1_one_vertex_own_nearest", 7),
      line<region_of_first_corner>(
          "view-line/region-of-first-corner",
          "the region that corner 0 is in at t=0, for all and for the step", "L1",
          "B2_region_of_vertex0_at_start", 7),
      line<frozen_nearest_point>("view-line/frozen-nearest-point",
                                 "the point nearest to corner 0 at t=0, for all and for the step",
                                 "L10", "B3_nearest_point_frozen", 7),
      line<of_centroid>("view-line/centroid", "the centroid alone, with its own nearest point",
                        "L1", "M_Lcentroid", 6),
      line<positive_from_either_end>("view-line/positive-from-either-end",
                                     "positive from q0 is enough, or from q1", "L10", "M_Leither",
                                     6),
      line<from_nearer_end>("view-line/nearer-end", "seen from the end nearer to corner 0 at t=0",
                            "L10", "F_line_nearer_end", 6),
      line<sampled<Sample::start>>("view-line/at-start-only",
                                   "the sign at t=0 is taken for the step's", "L2", "M_Lstartall",
                                   4),
      line<sampled<Sample::start, Sample::end>>("view-line/at-ends-only",
                                                "equal signs at t=0 and t=1 are the step's", "L2",
                                                "M_Lendsall", 5),
      line<from_midpoint>("view-line/midpoint-with-winding-of-an-end",
                          "seen from the line's midpoint, while the winding number is that of q0",
                          "L5", "F_line_midpoint_winding", 6),
      equivalent<from_first_end>("view-line/from-first-end", "seen from q0 only",
                                 "a single continuous field: the view from a point"),
      midpoint_with_its_winding(equivalent<from_midpoint>(
          "view-line/from-midpoint", "seen from the midpoint only, with its winding number",
          "a single continuous field: the view from a point")),
      equivalent<from_unclamped_axis>("view-line/unclamped-axis",
                                      "seen from the whole axis, not from the segment",
                                      "a single continuous field: the view from the axis"),
      equivalent<with_swapped_ends>("view-line/swapped-ends", "q0 and q1 exchanged",
                                    "the same field: the segment has no direction"),
  };
}

}  // namespace assay::properties
