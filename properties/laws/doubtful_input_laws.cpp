// L12: the answer is never free on a guess.
#include <fmt/format.h>

#include "properties/laws/facts/bad_input.h"
#include "properties/laws/facts/doubtful_surface.h"
#include "properties/laws/law_groups.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::Answer;

bool any_zero_area(CaseFacts& facts, std::size_t s) {
  const auto count = static_cast<std::int32_t>(facts.surface().mesh.triangles.size());
  for (std::int32_t t = 0; t < count; ++t) {
    if (has_zero_area(facts, s, t)) return true;
  }
  return false;
}

Observation free_only_when_the_oracle_says_so(CaseFacts& facts, std::size_t s, bool doubtful) {
  if (!doubtful || !facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  return holds_if(facts.result(s).answer != Answer::free || facts.judgement(s).pairs.empty(),
                  "free, and the oracle has a contact");
}

Observation broken_edges(CaseFacts& facts, std::size_t s) {
  return free_only_when_the_oracle_says_so(facts, s, has_broken_edges(facts));
}

Observation collapsed(CaseFacts& facts, std::size_t s) {
  return free_only_when_the_oracle_says_so(
      facts, s, has_coincident_vertices(facts, s) || any_zero_area(facts, s));
}

Observation several_layers(CaseFacts& facts, std::size_t s) {
  return free_only_when_the_oracle_says_so(facts, s,
                                           facts.has_views(s) && has_several_layers(facts, s));
}

Observation zero_area_stays_in_v0(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s)) return not_met();
  bool premise_held = false;
  const auto count = static_cast<std::int32_t>(facts.surface().mesh.triangles.size());
  for (std::int32_t t = 0; t < count; ++t) {
    if (!has_zero_area(facts, s, t)) continue;
    premise_held = true;
    if (facts.result(s).signs[at(t)] != detector::ViewSign::zero) {
      return fmt::format("triangle {} has no area at an end, and a sign", t);
    }
  }
  return premise_held ? holds() : not_met();
}

constexpr Law doubtful_input_law_table[] = {
    {"L12_NeverFreeOnAGuess_BrokenEdges", "L12",
     "A mesh with edges of three or more triangles, or used twice in one direction, is answered "
     "free only when it is.",
     "pair set", each_step<broken_edges>},
    {"L12_NeverFreeOnAGuess_Collapsed", "L12",
     "A mesh with triangles of no area or vertices at one place is answered free only when it is.",
     "pair set", each_step<collapsed>},
    {"L12_NeverFreeOnAGuess_SeveralLayers", "L12",
     "A mesh with untouched triangles of one component on several layers is answered free only "
     "when it is.",
     "pair set, layers", each_step<several_layers>},
    {"L12_ZeroAreaStaysInV0", "L12",
     "A triangle that is a segment or a point at an end of the step has no sign.", "nothing",
     each_step<zero_area_stays_in_v0>},
    {"L12_BadInputIsNamedAndChangesNothing", "L12",
     "An index out of range or repeated, three vertices used twice, a frame of another size, a "
     "coordinate that is not finite, a wrong number of primitives and a commit of nothing are each "
     "refused by name, and the next valid step is answered as if they had not been.",
     "nothing", check_bad_input, one_case_in_16},
};

}  // namespace

std::span<const Law> doubtful_input_laws() { return doubtful_input_law_table; }

}  // namespace assay::properties
