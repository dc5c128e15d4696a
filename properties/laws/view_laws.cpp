// L1 and L2: the view function at a time, and its signs over a step.
//
// L1: the view function of a triangle is the clamp form, and it takes its extremes at the corners.

#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/facts/view_values.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

using detector::ViewSign;

// Looks at some triangles of the surface at some times. They are the same ones whenever the case
// is looked at.
template <class Look>
Observation each_sample(CaseFacts& facts, std::size_t s, Look look) {
  if (!facts.has_views(s)) return not_met();
  constexpr int triangles = 2, times = 2;
  Random random(Random::hash(facts.source().id), s);
  const auto& surface = facts.surface().all();
  const auto start = facts.all_t0(s), end = facts.all_t1(s);
  const detector::SteppedMesh motion = {start, end};
  for (int i = 0; i < triangles; ++i) {
    const auto t =
        static_cast<std::size_t>(random.below(static_cast<int>(surface.triangles.size())));
    const auto c = at(surface.component_of_triangle[t]);
    const auto& corners = surface.triangles[t];
    const std::array<detector::MovingPoint, 3> triangle = {
        motion.path(corners[0]), motion.path(corners[1]), motion.path(corners[2])};
    for (int k = 0; k < times; ++k) {
      const int eighths = random.between(0, 8);
      const ExactView view(triangle, facts.result(s).primitives[c], eighths);
      const std::string wrong = look(view, facts.result(s).signs[t], random);
      if (!wrong.empty()) return fmt::format("triangle {} at t = {}/8: {}", t, eighths, wrong);
    }
  }
  return holds();
}

std::array<int, 3> any_weights(Random& random) {
  const int a = random.between(0, 16), b = random.between(0, 16 - a);
  return {a, b, 16 - a - b};
}

Observation clamp_form_is_region_form(CaseFacts& facts, std::size_t s) {
  return each_sample(facts, s, [](const ExactView& view, ViewSign, Random& random) -> std::string {
    for (int i = 0; i < 3; ++i) {
      if (view.by_clamp(view.corner(i)) != view.by_region(view.corner(i))) {
        return fmt::format("corner {}: the clamp form differs from region {}", i,
                           static_cast<int>(view.region_of(view.corner(i))));
      }
    }
    const auto x = view.inner_point(any_weights(random));
    if (view.by_clamp(x) != view.by_region(x)) return "an inner point has two values";
    return {};
  });
}

Observation inner_values_lie_between_corners(CaseFacts& facts, std::size_t s) {
  return each_sample(facts, s, [](const ExactView& view, ViewSign, Random& random) -> std::string {
    const std::array<ExactInteger, 3> at_corners = {view.by_region(view.corner(0)),
                                                    view.by_region(view.corner(1)),
                                                    view.by_region(view.corner(2))};
    const auto [least, greatest] = std::minmax_element(at_corners.begin(), at_corners.end());
    const ExactInteger inside = view.by_region(view.inner_point(any_weights(random)));
    if (inside < *least || inside > *greatest) return "an inner value is beyond the corners'";
    return {};
  });
}

// The signs come from the detector. So this law ties what the detector says to the function that
// L1 speaks of.
Observation signs_hold_inside(CaseFacts& facts, std::size_t s) {
  return each_sample(
      facts, s, [](const ExactView& view, ViewSign sign, Random& random) -> std::string {
        const auto wanted = static_cast<int>(sign);
        if (wanted == 0) return {};
        const std::array<ExactPoint, 4> places = {view.corner(0), view.corner(1), view.corner(2),
                                                  view.inner_point(any_weights(random))};
        for (const auto& x : places) {
          if (view.by_region(x).sign() != wanted) {
            return fmt::format("called {}, but a value has sign {}", wanted,
                               view.by_region(x).sign());
          }
        }
        return {};
      });
}

constexpr Law view_value_law_table[] = {
    {"L1_ClampFormIsRegionForm", "L1",
     "With s the axial coordinate clamped to [0,1], (1-s) f0 + s f1 is the view value seen from q0 "
     "before it (R0), from q1 beyond it (R1), and from the foot of the perpendicular between (R2).",
     "nothing: exact rationals at sampled times", each_step<clamp_form_is_region_form>},
    {"L1_InnerValuesLieBetweenCornerValues", "L1",
     "The view value at any point of a triangle lies between the least and the greatest of its "
     "three corners, each seen from its own nearest point.",
     "nothing: exact rationals at sampled times", each_step<inner_values_lie_between_corners>},
    {"L1_SignsHoldAtEveryPoint", "L1",
     "Where the detector calls a triangle positive or negative, every view value of it has that "
     "sign, at corners and inside.",
     "nothing: exact rationals at sampled times", each_step<signs_hold_inside>},
};

}  // namespace

std::span<const Law> view_value_laws() { return view_value_law_table; }

// L2: the signs over a step. Also that the view sets are disjoint, and together are all triangles.

namespace {

// Compares the signs of the triangles from `begin` to `end` of the surface. It looks only at
// components whose primitive is a point, or only at those whose primitive is not.
Observation compare_signs(CaseFacts& facts, std::size_t s, std::size_t begin, std::size_t end,
                          bool point) {
  if (!facts.has_views(s)) return not_met();
  const auto& result = facts.result(s);
  bool premise_held = false;
  for (std::size_t t = begin; t < end; ++t) {
    const auto c = facts.surface().all().component_of_triangle[t];
    if (result.primitives[at(c)].is_point() != point) continue;
    premise_held = true;
    const auto exact = facts.signs(s)[t];
    if (result.signs[t] != exact) {
      return fmt::format("triangle {}: detector {}, oracle {}", t,
                         static_cast<int>(result.signs[t]), static_cast<int>(exact));
    }
  }
  return premise_held ? holds() : not_met();
}

template <bool point>
Observation mesh_signs(CaseFacts& facts, std::size_t s) {
  return compare_signs(facts, s, 0, facts.surface().mesh.triangles.size(), point);
}

template <bool point>
Observation ghost_signs(CaseFacts& facts, std::size_t s) {
  return compare_signs(facts, s, facts.surface().mesh.triangles.size(),
                       facts.surface().all().triangles.size(), point);
}

Observation sets_are_disjoint_and_cover(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s)) return not_met();
  const auto& r = facts.result(s);
  std::size_t positive = 0, negative = 0, zero = 0, against_all = 0, violated = 0, dirty = 0;
  for (std::size_t t = 0; t < r.doubts.size(); ++t) {
    violated += (r.doubts[t] & detector::doubt::violated) != 0;
    dirty += (r.doubts[t] & detector::doubt::dirty) != 0;
    auto& set = r.doubts[t] != 0                   ? against_all
                : r.signs[t] == ViewSign::positive ? positive
                : r.signs[t] == ViewSign::negative ? negative
                                                   : zero;
    ++set;
  }
  const auto sum = r.view_positive + r.view_negative + r.view_zero + r.against_all;
  if (sum != facts.surface().mesh.triangles.size()) {
    return fmt::format("{} triangles in the sets of {}", sum, r.doubts.size());
  }
  if (r.view_positive != positive || r.view_negative != negative || r.view_zero != zero ||
      r.against_all != against_all || r.violated != violated || r.dirty != dirty) {
    return fmt::format(
        "sizes {} {} {} {} ({} violated, {} dirty), by triangle {} {} {} {} ({}, {})",
        r.view_positive, r.view_negative, r.view_zero, r.against_all, r.violated, r.dirty, positive,
        negative, zero, against_all, violated, dirty);
  }
  return holds();
}

constexpr Law view_set_law_table[] = {
    {"L2_SignsAreTheOracles_Point", "L2",
     "Seen from a point, the sign of each triangle of the mesh over the whole step is the exact "
     "one: positive at all times, negative at all times, or zero.",
     "view signs", each_step<mesh_signs<true>>},
    {"L2_SignsAreTheOracles_Line", "L2",
     "The same seen from a segment, fixed, translating, or with ends that move apart.",
     "view signs", each_step<mesh_signs<false>>},
    {"L2_GhostSignsAreTheOracles_Point", "L2",
     "Seen from a point, the sign of each ghost over the step is the exact one.", "view signs",
     each_step<ghost_signs<true>>},
    {"L2_GhostSignsAreTheOracles_Line", "L2",
     "Seen from a segment, the sign of each ghost over the step is the exact one.", "view signs",
     each_step<ghost_signs<false>>},
    {"Sets_AreDisjointAndCover", "sets",
     "V+, V-, V0 and Vv hold each triangle of the mesh once, by its doubts and else by its sign; "
     "the sizes reported are those of these sets.",
     "nothing", each_step<sets_are_disjoint_and_cover>},
};

}  // namespace

std::span<const Law> view_set_laws() { return view_set_law_table; }

}  // namespace assay::properties
