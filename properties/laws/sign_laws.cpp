// L4 and L5: what follows when all triangles have one sign.
//
// L4: if all triangles have one sign and none is in doubt, there is no contact.

#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/step_law.h"

namespace assay::properties {

namespace {

using detector::ViewPrimitive;
using detector::ViewSign;

bool is_point(const ViewPrimitive& q) { return q.is_point(); }
bool is_fixed_line(const ViewPrimitive& q) {
  return !q.is_point() && q.q0.t0 == q.q0.t1 && q.q1.t0 == q.q1.t1;
}
bool is_moving_line(const ViewPrimitive& q) { return !q.is_point() && !is_fixed_line(q); }
bool is_any(const ViewPrimitive&) { return true; }

bool is_all_of(CaseFacts& facts, std::size_t s, std::size_t component, ViewSign sign) {
  const auto& own = facts.surface().mesh.components[component].triangles;
  return std::all_of(own.begin(), own.end(), [&](std::int32_t t) {
    return !facts.in_doubt(s, t) && facts.signs(s)[at(t)] == sign;
  });
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

constexpr Law one_sign_law_table[] = {
    {"L4_AllPositiveIsCollisionFree_Point", "L4",
     "A component whose V-, V0 and Vv are empty, seen from a point, has no contact in the step.",
     "pair set, view signs", each_step<one_sign_is_collision_free<ViewSign::positive, is_point>>},
    {"L4_AllPositiveIsCollisionFree_Line", "L4", "The same seen from a segment that stands still.",
     "pair set, view signs",
     each_step<one_sign_is_collision_free<ViewSign::positive, is_fixed_line>>},
    {"L4_AllPositiveIsCollisionFree_MovingLine", "L4",
     "The same seen from a segment whose ends move.", "pair set, view signs",
     each_step<one_sign_is_collision_free<ViewSign::positive, is_moving_line>>},
    {"L4_AllNegativeIsCollisionFree", "L4",
     "The mirror: a component whose V+, V0 and Vv are empty has no contact in the step.",
     "pair set, view signs", each_step<one_sign_is_collision_free<ViewSign::negative, is_any>>},
};

}  // namespace

std::span<const Law> one_sign_laws() { return one_sign_law_table; }

// L5: all of S is positive and the winding number is 1, whatever was before.

namespace {

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

template <bool closed>
Observation all_positive_is_free(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s)) return not_met();
  bool premise_held = false;
  for (std::size_t c = 0; c < facts.surface().mesh.components.size(); ++c) {
    if (is_cycle(facts, c) != closed || !facts.is_free_by_view(s, c)) continue;
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
    return holds_if(facts.result(s).answer == detector::Answer::free, "not answered free");
  }
  return holds();
}

constexpr Law all_positive_law_table[] = {
    {"L5_AllPositiveAndWindingOneIsFree_Closed", "L5",
     "A closed component that is positive over the step and has winding number 1 at its primitive "
     "at t=0 is free whatever came before, and at both ends every triangle is clean, of layer "
     "(1,0).",
     "pair set, view signs, winding number, layers", each_step<all_positive_is_free<true>>},
    {"L5_AllPositiveAndWindingOneIsFree_Unclosed", "L5",
     "The same for a component with holes when its ghosts are positive too; then no ghost touches "
     "anything.",
     "pair set, view signs, winding number, layers, triangles touched by ghosts",
     each_step<all_positive_is_free<false>>},
    {"L5_TheFreePathIsTaken", "L5",
     "The detector releases exactly the components that are positive with their ghosts and have "
     "winding number 1, and answers free when that is all of them and no two components meet.",
     "pair set, view signs, winding number", each_step<detector_takes_the_free_path>},
};

}  // namespace

std::span<const Law> all_positive_laws() { return all_positive_law_table; }

}  // namespace assay::properties
