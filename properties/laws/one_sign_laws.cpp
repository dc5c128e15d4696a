// L4: if all triangles have one sign and none is in doubt, there is no contact.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/law_groups.h"
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

}  // namespace assay::properties
