// L2: the signs over a step. Also that the view sets are disjoint, and together are all triangles.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/law_groups.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::ViewSign;

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
