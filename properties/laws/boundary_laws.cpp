// L11: the violated set of unclosed meshes.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/facts/carried_state.h"
#include "properties/laws/metamorphic/change_law.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
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

// The triangles that ghosts have touched since the last new start, up to the end of step s, and
// that the oracle did not find clean at the start of any step since. This is computed from the
// oracle alone.
TriangleFlags touched_until(CaseFacts& facts, std::size_t s) {
  TriangleFlags held = facts.touched(s);
  const auto p = facts.known_from(s);
  if (!p || !facts.has_views(*p)) return held;
  const TriangleFlags before = touched_until(facts, *p);
  const TriangleFlags clean = may_be_clean(facts, s, before);
  for (std::size_t t = 0; t < held.size(); ++t) held[t] |= before[t] && !clean[t];
  return held;
}

// An apex must not jump between two steps. If both steps had views, both have apexes; otherwise
// the premise does not hold.
Observation apexes_go_on(CaseFacts& facts, std::size_t s) {
  const auto& before = facts.known_from(s);
  if (!before) return not_met();
  const auto &was = facts.result(*before).apexes, &is = facts.result(s).apexes;
  if (was.empty() || is.empty()) return not_met();
  const bool same = std::equal(was.begin(), was.end(), is.begin(), is.end(),
                               [](const auto& a, const auto& b) { return a.t1 == b.t0; });
  return holds_if(same, "an apex jumps between two steps");
}

Observation vv_holds_what_was_touched(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  if (facts.surface().is_closed() || !p || !facts.has_views(s) || !facts.has_views(*p)) {
    return not_met();
  }
  if (!facts.is_trusted(s)) return not_met();
  const TriangleFlags held = touched_until(facts, *p);
  if (std::find(held.begin(), held.end(), 1) == held.end()) return not_met();
  const TriangleFlags clean = may_be_clean(facts, s, held);
  for (std::size_t t = 0; t < held.size(); ++t) {
    if (held[t] && !clean[t] && facts.result(s).doubts[t] == 0) {
      return fmt::format("triangle {} was touched, is not clean, and left Vv", t);
    }
  }
  return holds();
}

constexpr Law boundary_law_table[] = {
    {"L11_ViolatedIsWhatGhostsTouch", "L11",
     "Violated are exactly the triangles that a ghost of their component touches at any time of "
     "the step (at a new start also those that it pierces at t=0).",
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
     "nothing", check_change<holes_in_another_order>},
};

}  // namespace

std::span<const Law> boundary_laws() { return boundary_law_table; }

}  // namespace assay::properties
