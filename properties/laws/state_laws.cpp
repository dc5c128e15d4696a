// L8, L9 and L15: which triangles are clean from step to step and at a new start. L11: which
// triangles ghosts touch.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/facts/case_facts.h"
#include "properties/laws/metamorphic/change_laws.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::Start;

bool any(const TriangleFlags& flags) { return std::ranges::find(flags, 1) != flags.end(); }

Observation carried_clean_is_clean(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.known_from(s) || !facts.is_trusted(s)) return not_met();
  TriangleFlags is_held = dirty_triangles(facts, s);
  for (auto& flag : is_held) flag = !flag;
  if (!any(is_held)) return not_met();
  return what_is_not_clean(facts, facts.layers_at_start(s), is_held);
}

Observation what_is_not_clean_stays_dirty(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  if (!p || !facts.has_views(s) || !facts.has_views(*p) || !facts.is_judged(*p)) return not_met();
  if (!facts.is_trusted(s)) return not_met();
  TriangleFlags in_question = dirty_triangles(facts, *p);
  for (std::size_t t = 0; t < in_question.size(); ++t) {
    in_question[t] |= facts.own_contacts(*p)[t] | facts.touched(*p)[t];
  }
  if (!any(in_question)) return not_met();
  const auto clean = may_be_clean(facts, s, in_question);
  const auto dirty = dirty_triangles(facts, s);
  for (std::size_t t = 0; t < dirty.size(); ++t) {
    if (in_question[t] && !clean[t] && !dirty[t]) {
      return fmt::format("triangle {} was released, but is not clean", t);
    }
  }
  return holds();
}

Observation clean_and_untouched_stays_clean(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  TriangleFlags is_held = dirty_triangles(facts, s);
  for (std::size_t t = 0; t < is_held.size(); ++t) {
    is_held[t] = !is_held[t] && !facts.own_contacts(s)[t] && !facts.touched(s)[t];
  }
  if (!any(is_held)) return not_met();
  const std::string wrong = what_is_not_clean(facts, facts.layers_at_end(s), is_held);
  if (!wrong.empty() || facts.options().pairs != detector::Pairs::all) return wrong;
  for (std::size_t next = s + 1; next < facts.steps(); ++next) {
    if (facts.known_from(next) != s || !facts.has_views(next)) continue;
    const auto dirty = dirty_triangles(facts, next);
    for (std::size_t t = 0; t < is_held.size(); ++t) {
      if (is_held[t] && dirty[t]) return fmt::format("triangle {} became dirty without cause", t);
    }
  }
  return holds();
}

// REQUIRES has_views(s) and has_account(s).
Observation compare_with_account(CaseFacts& facts, std::size_t s) {
  const auto account = account_of_dirty(facts, s);
  const auto dirty = dirty_triangles(facts, s);
  for (std::size_t t = 0; t < dirty.size(); ++t) {
    if (dirty[t] == account[t]) continue;
    return fmt::format("triangle {} is {}, but {} by the oracle", t, dirty[t] ? "dirty" : "clean",
                       account[t] ? "dirty" : "clean");
  }
  return holds();
}

bool has_doubts_to_compare(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  return p && facts.has_views(s) && has_account(facts, s) && any(in_doubt_after(facts, *p));
}

Observation dirty_is_the_oracles_account(CaseFacts& facts, std::size_t s) {
  return has_doubts_to_compare(facts, s) ? compare_with_account(facts, s) : not_met();
}

Observation steps_without_views_are_in_the_account(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  if (!p || facts.has_views(*p) || !has_doubts_to_compare(facts, s)) return not_met();
  return compare_with_account(facts, s);
}

Observation new_start_is_the_oracles_layers(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || facts.known_from(s) || facts.options().start != Start::verified) {
    return not_met();
  }
  const auto& clean = facts.layers_at_start(s).clean;
  const auto dirty = dirty_triangles(facts, s);
  for (std::size_t t = 0; t < dirty.size(); ++t) {
    if (dirty[t] && facts.starts_by_view_alone()) continue;
    if ((dirty[t] != 0) == (clean[t] != 0)) {
      return fmt::format("triangle {} is {}, but {} by the oracle", t, dirty[t] ? "dirty" : "clean",
                         clean[t] ? "clean" : "not");
    }
  }
  return holds();
}

Observation all_positive_at_the_start_releases(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s)) return not_met();
  if (!facts.known_from(s) && facts.options().start == Start::unknown) return not_met();
  bool premise_held = false;
  for (std::size_t c = 0; c < facts.surface().mesh.components.size(); ++c) {
    if (!is_free_by_view_at_start(facts, s, c)) continue;
    premise_held = true;
    for (const auto t : facts.surface().mesh.components[c].triangles) {
      const auto i = at(t);
      if (!facts.layers_at_start(s).clean[i]) return fmt::format("triangle {} is not clean", t);
      if (facts.result(s).doubts[i] & detector::doubt::dirty) {
        return fmt::format("triangle {} is not released", t);
      }
    }
  }
  return premise_held ? holds() : not_met();
}

constexpr Law state_law_table[] = {
    {"L8_CarriedCleanIsClean", "L8",
     "At the start of a step that continues from a committed one, clean triangles touch nothing of "
     "S and have one layer in each component.",
     "layers", each_step<carried_clean_is_clean>, 1, PremiseScope::each_culling},
    {"L8_WhatIsNotCleanStaysDirty", "L8",
     "A triangle that was dirty, in contact with its own component or touched by a ghost, and is "
     "not clean at the end, is dirty in the next step.",
     "pair set, triangles touched by ghosts, layers", each_step<what_is_not_clean_stays_dirty>, 1,
     PremiseScope::each_culling},
    {"L8_CleanAndUntouchedStaysClean", "L8",
     "Triangles that are clean at the start, in no contact with their own component and touched by "
     "no ghost, are untouched and of one layer at the end, and clean in the next step.",
     "pair set, triangles touched by ghosts, layers", each_step<clean_and_untouched_stays_clean>, 1,
     PremiseScope::each_culling},
    {"L9_DirtyIsTheOraclesAccount", "L9",
     "At the start of a step that continues from a committed one, a triangle is dirty exactly if "
     "it was dirty, touched by a ghost or in contact with its own component in the step before, "
     "and now touches something or is not of the common layer of its component.",
     "pair set, triangles touched by ghosts, layers", each_step<dirty_is_the_oracles_account>, 1,
     PremiseScope::each_culling},
    {"L9_NewStartIsTheOraclesLayers", "L9",
     "At a verified new start a triangle is dirty exactly if it touches S or is not of the common "
     "layer of its component; `--culling view-auto` skips layers, so more can be dirty.",
     "layers", each_step<new_start_is_the_oracles_layers>, 1, PremiseScope::each_culling},
    {"L9_AllPositiveAtTheStartReleases", "L9",
     "If all of S is positive at t=0 and has winding number 1 at the primitive, the component is "
     "clean, whatever came before.",
     "view signs at rest, winding number, layers", each_step<all_positive_at_the_start_releases>, 1,
     PremiseScope::each_culling},
    {"L15_StepsWithoutViewsAreInTheAccount", "L15",
     "After a step without views, a triangle is dirty if the step left it in doubt and it now "
     "touches something or is not of the common layer. The step leaves in doubt all triangles of "
     "components with ghosts, and a first step also the triangles that are dirty by L9.",
     "pair set, triangles touched by ghosts, layers",
     each_step<steps_without_views_are_in_the_account>, 1, PremiseScope::each_that_chooses_views},
};

}  // namespace

std::span<const Law> state_laws() { return state_law_table; }

// L11: the violated set of unclosed meshes.

namespace {

Observation violated_is_what_ghosts_touch(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || facts.surface().is_closed()) return not_met();
  const auto& doubts = facts.result(s).doubts;
  for (std::size_t t = 0; t < doubts.size(); ++t) {
    const bool violated = (doubts[t] & detector::doubt::violated) != 0;
    if (violated != (facts.touched(s)[t] != 0)) {
      return fmt::format("triangle {} is {}violated, by the oracle {}touched", t,
                         violated ? "" : "not ", facts.touched(s)[t] ? "" : "not ");
    }
  }
  return holds();
}

// Returns the triangles that ghosts have touched since the last new start, up to the end of step s,
// and that the oracle did not find clean at the start of any step since. This is computed from the
// oracle alone.
TriangleFlags touched_until(CaseFacts& facts, std::size_t s) {
  TriangleFlags is_held = facts.touched(s);
  const auto p = facts.known_from(s);
  if (!p || !facts.has_views(*p)) return is_held;
  const TriangleFlags before = touched_until(facts, *p);
  const TriangleFlags clean = may_be_clean(facts, s, before);
  for (std::size_t t = 0; t < is_held.size(); ++t) is_held[t] |= before[t] && !clean[t];
  return is_held;
}

// Observes whether apexes go on: an apex must not jump between two steps. If both steps had views,
// both have apexes; otherwise the premise does not hold.
Observation apexes_go_on(CaseFacts& facts, std::size_t s) {
  const auto& before = facts.known_from(s);
  if (!before) return not_met();
  const auto &was = facts.result(*before).apexes, &is = facts.result(s).apexes;
  if (was.empty() || is.empty()) return not_met();
  const bool same =
      std::ranges::equal(was, is, [](const auto& a, const auto& b) { return a.t1 == b.t0; });
  return holds_if(same, "an apex jumps between two steps");
}

Observation vv_holds_what_was_touched(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  if (facts.surface().is_closed() || !p || !facts.has_views(s) || !facts.has_views(*p)) {
    return not_met();
  }
  if (!facts.is_trusted(s)) return not_met();
  const TriangleFlags is_held = touched_until(facts, *p);
  if (std::ranges::find(is_held, 1) == is_held.end()) return not_met();
  const TriangleFlags clean = may_be_clean(facts, s, is_held);
  for (std::size_t t = 0; t < is_held.size(); ++t) {
    if (is_held[t] && !clean[t] && facts.result(s).doubts[t] == 0) {
      return fmt::format("triangle {} was touched and is not clean, but left Vv", t);
    }
  }
  return holds();
}

constexpr Law boundary_law_table[] = {
    {"L11_ViolatedIsWhatGhostsTouch", "L11",
     "A triangle is violated exactly if a ghost of its component touches it at any time of the "
     "step (at a new start, also if a ghost pierces it at t=0).",
     "triangles touched by ghosts", each_step<violated_is_what_ghosts_touch>},
    {"L11_VvHoldsWhatWasTouchedUntilClean", "L11",
     "A triangle that a ghost touched in a committed step is in Vv of the following ones until it "
     "is clean again.",
     "triangles touched by ghosts, layers", each_step<vv_holds_what_was_touched>},
    {"L11_ApexesGoOnFromWhereTheyWere", "L11",
     "The apex of each hole starts where it ended in the step before.", "nothing",
     each_step<apexes_go_on>},
    {"L11_OrderOfHolesDoesNotMatter", "L11",
     "With the holes in another order (vertices numbered backwards, triangles listed backwards, "
     "apexes where they were) the same triangles are violated and dirty, and all else is the same.",
     "nothing", check_change<changes::backwards>},
};

}  // namespace

std::span<const Law> boundary_laws() { return boundary_law_table; }

}  // namespace assay::properties
