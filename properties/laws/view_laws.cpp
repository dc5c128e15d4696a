// L1, L2, L4 and L5: the view function at a time, its signs over a step, and the consequences if
// all triangles have one sign.
//
// L1: the view function of a triangle is the clamp form, and it takes its extremes at the corners.

#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/facts/case_facts.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

// Looks at some triangles of the surface at some times. They are the same ones whenever the case
// is looked at.
template <class Look>
Observation each_sample(CaseFacts& facts, std::size_t s, Look look) {
  if (!facts.has_views(s)) return not_met();
  constexpr int triangles = 2, times = 2;
  Random random(Random::hash(facts.source().id), s);
  const auto& surface = facts.surface().all();
  const auto start = facts.all_t0(s), end = facts.all_t1(s);
  const SteppedMesh motion = {start, end};
  for (int i = 0; i < triangles; ++i) {
    const auto t =
        static_cast<std::size_t>(random.below(static_cast<int>(surface.triangles.size())));
    const auto c = at(surface.component_of_triangle[t]);
    const auto& corners = surface.triangles[t];
    const std::array<MovingPoint, 3> triangle = {motion.path(corners[0]), motion.path(corners[1]),
                                                 motion.path(corners[2])};
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
        return fmt::format("corner {}: clamp form and form of region {} differ", i,
                           static_cast<int>(view.region_of(view.corner(i))));
      }
    }
    const auto x = view.inner_point(any_weights(random));
    if (view.by_clamp(x) != view.by_region(x)) return "the forms differ at an inner point";
    return {};
  });
}

Observation inner_values_lie_between_corners(CaseFacts& facts, std::size_t s) {
  return each_sample(facts, s, [](const ExactView& view, ViewSign, Random& random) -> std::string {
    const std::array<ExactInteger, 3> at_corners = {view.by_region(view.corner(0)),
                                                    view.by_region(view.corner(1)),
                                                    view.by_region(view.corner(2))};
    const auto [least, greatest] = std::ranges::minmax_element(at_corners);
    const ExactInteger inside = view.by_region(view.inner_point(any_weights(random)));
    if (inside < *least || inside > *greatest) return "an inner value is out of the corners' range";
    return {};
  });
}

// Observes the detector's signs. So this law ties the detector's answers to the view function of
// L1.
Observation signs_hold_inside(CaseFacts& facts, std::size_t s) {
  return each_sample(
      facts, s, [](const ExactView& view, ViewSign sign, Random& random) -> std::string {
        const auto sign_number = static_cast<int>(sign);
        if (sign_number == 0) return {};
        const std::array<ExactPoint, 4> places = {view.corner(0), view.corner(1), view.corner(2),
                                                  view.inner_point(any_weights(random))};
        for (const auto& x : places) {
          if (view.by_region(x).sign() != sign_number) {
            return fmt::format("called {}, but a value has sign {}", sign_number,
                               view.by_region(x).sign());
          }
        }
        return {};
      });
}

// L2: the signs over a step. And: the view sets are disjoint, and together are all triangles.

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
    return fmt::format("the sets hold {} of {} triangles", sum, r.doubts.size());
  }
  if (r.view_positive != positive || r.view_negative != negative || r.view_zero != zero ||
      r.against_all != against_all || r.violated != violated || r.dirty != dirty) {
    return fmt::format("stated {} {} {} {} ({} violated, {} dirty), counted {} {} {} {} ({}, {})",
                       r.view_positive, r.view_negative, r.view_zero, r.against_all, r.violated,
                       r.dirty, positive, negative, zero, against_all, violated, dirty);
  }
  return holds();
}

constexpr Law view_law_table[] = {
    {"L1_ClampFormIsRegionForm", "L1",
     "If s is the axial coordinate clamped to [0,1], (1-s) f0 + s f1 is the view value: before q0 "
     "seen from q0 (R0), beyond q1 from q1 (R1), between them from the perpendicular's foot (R2).",
     "nothing: exact rationals at sampled times", each_step<clamp_form_is_region_form>},
    {"L1_InnerValuesLieBetweenCornerValues", "L1",
     "The view value at any point of a triangle lies between the least and the greatest of its "
     "three corners, each seen from its own nearest point.",
     "nothing: exact rationals at sampled times", each_step<inner_values_lie_between_corners>},
    {"L1_SignsHoldAtEveryPoint", "L1",
     "If the detector calls a triangle positive or negative, every view value of the triangle has "
     "that sign, at corners and inside.",
     "nothing: exact rationals at sampled times", each_step<signs_hold_inside>},
    {"L2_SignsAreTheOracles_Point", "L2",
     "Seen from a point, the sign of each triangle of the mesh over the whole step is the exact "
     "one: positive at all times, negative at all times, or zero.",
     "view signs", each_step<mesh_signs<true>>},
    {"L2_SignsAreTheOracles_Line", "L2",
     "Seen from a segment, at rest or moving, the sign of each triangle over the step is exact.",
     "view signs", each_step<mesh_signs<false>>},
    {"L2_GhostSignsAreTheOracles_Point", "L2",
     "Seen from a point, the sign of each ghost over the step is the exact one.", "view signs",
     each_step<ghost_signs<true>>},
    {"L2_GhostSignsAreTheOracles_Line", "L2",
     "Seen from a segment, the sign of each ghost over the step is the exact one.", "view signs",
     each_step<ghost_signs<false>>},
    {"Sets_AreDisjointAndCover", "sets",
     "Each triangle of the mesh is in one of V+, V-, V0 and Vv, by its doubts if it has any, "
     "otherwise by its sign; the sizes reported are those of these sets.",
     "nothing", each_step<sets_are_disjoint_and_cover>},
};

}  // namespace

std::span<const Law> view_laws() { return view_law_table; }

// L4: if all triangles have one sign and none is in doubt, there is no contact.

namespace {

bool is_point(const ViewPrimitive& q) { return q.is_point(); }
bool is_fixed_line(const ViewPrimitive& q) {
  return !q.is_point() && q.q0.t0 == q.q0.t1 && q.q1.t0 == q.q1.t1;
}
bool is_moving_line(const ViewPrimitive& q) { return !q.is_point() && !is_fixed_line(q); }
bool is_any(const ViewPrimitive&) { return true; }

bool is_all_of(CaseFacts& facts, std::size_t s, std::size_t component, ViewSign sign) {
  const auto& own = facts.surface().mesh.components[component].triangles;
  return std::ranges::all_of(
      own, [&](std::int32_t t) { return !facts.in_doubt(s, t) && facts.signs(s)[at(t)] == sign; });
}

template <ViewSign sign, bool (*applies)(const ViewPrimitive&)>
Observation one_sign_is_collision_free(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  bool premise_held = false;
  for (std::size_t c = 0; c < facts.surface().mesh.components.size(); ++c) {
    if (!applies(facts.result(s).primitives[c]) || !is_all_of(facts, s, c, sign)) continue;
    premise_held = true;
    for (const auto t : facts.surface().mesh.components[c].triangles) {
      if (facts.own_contacts(s)[at(t)]) {
        return fmt::format("component {} is of one sign, and triangle {} is in contact", c, t);
      }
    }
  }
  return premise_held ? holds() : not_met();
}

// L5: all of S is positive and the winding number is 1, whatever was before.

bool is_cycle(const CaseFacts& facts, std::size_t component) {
  return facts.surface().mesh.components[component].is_cycle;
}

std::string what_is_not_free(CaseFacts& facts, std::size_t s, std::size_t component) {
  for (const auto t : facts.surface().mesh.components[component].triangles) {
    if (facts.own_contacts(s)[at(t)]) return fmt::format("triangle {} is in contact", t);
    if (facts.touched(s)[at(t)]) return fmt::format("triangle {} is touched by a ghost", t);
    for (const auto* layers : {&facts.layers_at_start(s), &facts.layers_at_end(s)}) {
      if (!layers->clean[at(t)] || *layers->layer[at(t)] != oracle::Layer{1, 0}) {
        return fmt::format("triangle {} is not clean at an end", t);
      }
    }
    if (facts.in_doubt(s, t)) return fmt::format("the detector doubts triangle {}", t);
  }
  for (const auto& contact : facts.result(s).pairs) {
    if (facts.same_component(contact.pair) &&
        facts.component_of(contact.pair.a) == static_cast<std::int32_t>(component)) {
      return fmt::format("the detector reports ({}, {})", contact.pair.a, contact.pair.b);
    }
  }
  return {};
}

template <bool is_closed>
Observation all_positive_is_free(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s)) return not_met();
  bool premise_held = false;
  for (std::size_t c = 0; c < facts.surface().mesh.components.size(); ++c) {
    if (is_cycle(facts, c) != is_closed || !facts.is_free_by_view(s, c)) continue;
    premise_held = true;
    const std::string wrong = what_is_not_free(facts, s, c);
    if (!wrong.empty()) return fmt::format("component {}: {}", c, wrong);
  }
  return premise_held ? holds() : not_met();
}

Observation detector_takes_the_free_path(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s)) return not_met();
  const auto components = facts.surface().mesh.components.size();
  std::size_t free = 0;
  for (std::size_t c = 0; c < components; ++c) free += facts.is_free_by_view(s, c);
  if (free == 0 && facts.result(s).counts.free_components == 0) return not_met();
  if (facts.result(s).counts.free_components != free) {
    return fmt::format("the detector released {} components, the oracle {}",
                       facts.result(s).counts.free_components, free);
  }
  const auto& pairs = facts.judgement(s).pairs;
  if (free == components && pairs.empty()) {
    return holds_if(facts.result(s).answer == Answer::free, "not answered free");
  }
  return holds();
}

constexpr Law one_sign_law_table[] = {
    {"L4_AllPositiveIsCollisionFree_Point", "L4",
     "Seen from a point, a component whose V-, V0 and Vv are empty has no contact in the step.",
     "pair set, view signs", each_step<one_sign_is_collision_free<ViewSign::positive, is_point>>},
    {"L4_AllPositiveIsCollisionFree_Line", "L4",
     "Seen from a segment at rest, a component whose V-, V0 and Vv are empty has no contact.",
     "pair set, view signs",
     each_step<one_sign_is_collision_free<ViewSign::positive, is_fixed_line>>},
    {"L4_AllPositiveIsCollisionFree_MovingLine", "L4",
     "Seen from a moving segment, a component whose V-, V0 and Vv are empty has no contact.",
     "pair set, view signs",
     each_step<one_sign_is_collision_free<ViewSign::positive, is_moving_line>>},
    {"L4_AllNegativeIsCollisionFree", "L4",
     "A component whose V+, V0 and Vv are empty has no contact in the step.",
     "pair set, view signs", each_step<one_sign_is_collision_free<ViewSign::negative, is_any>>},
    {"L5_AllPositiveAndWindingOneIsFree_Closed", "L5",
     "A closed component that is positive over the step and has winding number 1 at its primitive "
     "at t=0 is free whatever came before, and at both ends every triangle is clean, of layer "
     "(1,0).",
     "pair set, view signs, winding number, layers", each_step<all_positive_is_free<true>>},
    {"L5_AllPositiveAndWindingOneIsFree_Unclosed", "L5",
     "With holes the same holds if all ghosts of the component are positive; then none touches it.",
     "pair set, view signs, winding number, layers, triangles touched by ghosts",
     each_step<all_positive_is_free<false>>},
    {"L5_TheFreePathIsTaken", "L5",
     "The detector releases exactly the components that are positive with their ghosts and have "
     "winding number 1, and answers free if these are all components and no two of them meet.",
     "pair set, view signs, winding number", each_step<detector_takes_the_free_path>},
};

}  // namespace

std::span<const Law> one_sign_laws() { return one_sign_law_table; }

}  // namespace assay::properties
