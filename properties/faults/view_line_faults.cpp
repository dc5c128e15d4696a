// Wrong view tests from a line: every corner needs its own nearest point, at every time (L1), and
// all triangles of a component one field of view rays (L10).
#include "detector/state/winding.h"
#include "properties/faults/planting.h"
#include "properties/faults/view_polynomials.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using detector::MovingTriangle;
using detector::Polynomial;
using detector::Stages;
using detector::ViewPrimitive;
using detector::ViewSign;

struct OneCorner : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    return sign_of(pieces_of_corner(view_polynomials(triangle, primitive), 0));
  }
};

// Region of corner 0 at t=0: one end of the line, or the foot on its axis.
struct RegionOfFirstCorner : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    const auto pieces = pieces_of_corner(view_polynomials(triangle, primitive), 0);
    if (pieces.g0.sign_at_zero() <= 0) return strict_sign(pieces.h0);
    if (pieces.g1.sign_at_zero() >= 0) return strict_sign(pieces.h1);
    return strict_sign(pieces.middle);
  }
};

// The point of the line nearest to corner 0 at t=0, for all corners and the whole step.
struct FrozenNearestPoint : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    const auto view = view_polynomials(triangle, primitive);
    if (view.g0[0].sign_at_zero() <= 0) return strict_sign(view.h0);
    if (view.g1[0].sign_at_zero() >= 0) return strict_sign(view.h1);
    const Polynomial along = at_start(view.g0[0]), length2 = at_start(view.length2);
    return strict_sign((length2 - along) * view.h0 + along * view.h1);
  }
};

// The centroid alone, with its own nearest point (all of it times 3).
struct Centroid : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    const auto view = view_polynomials(triangle, primitive);
    const Polynomial g0 = view.g0[0] + view.g0[1] + view.g0[2];
    const Polynomial g1 = view.g1[0] + view.g1[1] + view.g1[2];
    const Polynomial three = Polynomial::constant(3);
    return sign_of({view.h0, view.h1, three * view.h0 * view.length2 - g0 * view.d_normal, g0, g1});
  }
};

struct PositiveFromEitherEnd : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    const auto view = view_polynomials(triangle, primitive);
    const ViewSign first = strict_sign(view.h0);
    return first == ViewSign::positive ? first : strict_sign(view.h1);
  }
};

// Seen from the end that is nearer to corner 0 at t=0.
struct NearerEnd : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    const auto view = view_polynomials(triangle, primitive);
    const bool second = (view.g0[0] + view.g1[0]).sign_at_zero() > 0;
    return strict_sign(second ? view.h1 : view.h0);
  }
};

template <Sample... samples>
struct Sampled : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    return common_sign({sign_at(samples, triangle, primitive)...});
  }
};
using LineAtStart = Sampled<Sample::start>;
using LineAtEnds = Sampled<Sample::start, Sample::end>;

ViewPrimitive midpoint(const ViewPrimitive& line) {
  ViewPrimitive view;
  for (std::size_t k = 0; k < 3; ++k) {
    view.q0.t0[k] = 0.5 * (line.q0.t0[k] + line.q1.t0[k]);
    view.q0.t1[k] = 0.5 * (line.q0.t1[k] + line.q1.t1[k]);
  }
  view.q1 = view.q0;
  return view;
}

struct FromMidpoint : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    return right_sign(triangle, midpoint(primitive));
  }
};

// The winding number where the view is from: that of an end would say nothing.
struct FreeFromMidpoint : detector::ReleaseRule {
  bool is_free(detector::StepWork& work, std::size_t c) const override {
    const auto& triangles = work.component(c).triangles;
    for (const auto t : triangles) {
      if (work.signs[static_cast<std::size_t>(t)] != ViewSign::positive) return false;
    }
    return detector::winding_number(work.surface.all(), triangles, work.x_t0,
                                    midpoint(work.primitives[c]).q0.t0) == 1;
  }
};

Stages midpoint_with_its_winding(const detector::Options& options) {
  Stages stages = with<&Stages::classifier, FromMidpoint>(options);
  stages.release = std::make_shared<FreeFromMidpoint>();
  return stages;
}

struct FromFirstEnd : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    return right_sign(triangle, {primitive.q0, primitive.q0});
  }
};

struct SwappedEnds : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    return right_sign(triangle, {primitive.q1, primitive.q0});
  }
};

// Across the whole axis: the middle piece everywhere.
struct UnclampedAxis : TriangleSigns {
  ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) const override {
    const auto view = view_polynomials(triangle, primitive);
    return common_sign({strict_sign(pieces_of_corner(view, 0).middle),
                        strict_sign(pieces_of_corner(view, 1).middle),
                        strict_sign(pieces_of_corner(view, 2).middle)});
  }
};

template <class Classifier>
Fault row(std::string_view name, std::string_view about, std::string_view law,
          std::string_view curated, int vertices) {
  return {
      name,       about,   law,      FaultStatus::planted, "",
      with_lines, curated, vertices, "classifier",         with<&Stages::classifier, Classifier>};
}

Fault equivalent(std::string_view name, std::string_view about, std::string_view reason,
                 Stages (*stages)(const detector::Options&)) {
  return {name, about,        "L10", FaultStatus::equivalent, reason, with_lines, "",
          0,    "classifier", stages};
}

}  // namespace

std::vector<Fault> view_line_faults() {
  return {
      row<OneCorner>("view-line/one-corner", "corner 0 alone, with its own nearest point", "L1",
                     "B1_one_vertex_own_nearest", 7),
      row<RegionOfFirstCorner>("view-line/region-of-first-corner",
                               "the region that corner 0 is in at t=0, for all and for the step",
                               "L1", "B2_region_of_vertex0_at_start", 7),
      row<FrozenNearestPoint>("view-line/frozen-nearest-point",
                              "the point nearest to corner 0 at t=0, for all and for the step",
                              "L10", "B3_nearest_point_frozen", 7),
      row<Centroid>("view-line/centroid", "the centroid alone, with its own nearest point", "L1",
                    "M_Lcentroid", 6),
      row<PositiveFromEitherEnd>("view-line/positive-from-either-end",
                                 "positive from q0 is enough, or from q1", "L10", "M_Leither", 6),
      row<NearerEnd>("view-line/nearer-end", "seen from the end nearer to corner 0 at t=0", "L10",
                     "F_line_nearer_end", 6),
      row<LineAtStart>("view-line/at-start-only", "the sign at t=0 is taken for the step's", "L2",
                       "M_Lstartall", 4),
      row<LineAtEnds>("view-line/at-ends-only", "equal signs at t=0 and t=1 are the step's", "L2",
                      "M_Lendsall", 5),
      row<FromMidpoint>("view-line/midpoint-with-winding-of-an-end",
                        "seen from the line's midpoint, while the winding number is that of q0",
                        "L5", "F_line_midpoint_winding", 6),
      equivalent("view-line/from-first-end", "seen from q0 only",
                 "a single continuous field: the view from a point",
                 with<&Stages::classifier, FromFirstEnd>),
      equivalent("view-line/from-midpoint", "seen from the midpoint only, with its winding number",
                 "a single continuous field: the view from a point", midpoint_with_its_winding),
      equivalent("view-line/unclamped-axis", "seen from the whole axis, not from the segment",
                 "a single continuous field: the view from the axis",
                 with<&Stages::classifier, UnclampedAxis>),
      equivalent("view-line/swapped-ends", "q0 and q1 exchanged",
                 "the same field: the segment has no direction",
                 with<&Stages::classifier, SwappedEnds>),
  };
}

}  // namespace assay::properties
