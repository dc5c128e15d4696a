// L3 and L6: what K holds of the contacts of a step, and what it may leave out.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "properties/judging/contact_parts.h"
#include "properties/laws/law_groups.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::PairContact;
using detector::TimeEnclosure;

bool all_outside(const ContactPart& part, const oracle::Candidates& k) {
  return std::none_of(part.begin(), part.end(),
                      [&](const PairContact& contact) { return k.holds(contact.pair); });
}

Observation first_contact_is_a_candidate(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  const auto& judgement = facts.judgement(s);
  if (judgement.pairs.empty()) return not_met();
  for (const auto& part : contact_parts(judgement.pairs, judgement.first)) {
    if (!all_outside(part, facts.candidates(s))) continue;
    return fmt::format("no pair at the place of ({}, {}) is in K at the first time {}",
                       part[0].pair.a, part[0].pair.b, judgement.first.lo);
  }
  return holds();
}

// Looks only at contacts inside a component, because pairs of two components are all in K and make
// nothing dirty (L10).
Observation outside_k_something_came_before(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  std::vector<PairContact> own;
  for (const auto& contact : facts.judgement(s).pairs) {
    if (facts.same_component(contact.pair)) own.push_back(contact);
  }
  constexpr TimeEnclosure never = {2, 2};
  std::vector<TimeEnclosure> first_of(facts.surface().mesh.triangles.size(), never);
  std::set<TimeEnclosure> times_outside;
  for (const auto& [pair, time, feature] : own) {
    for (const auto t : {pair.a, pair.b}) {
      auto& first = first_of[at(t)];
      first = std::min(first, time);
    }
    if (!facts.candidates(s).holds(pair)) times_outside.insert(time);
  }
  bool premise_held = false;
  for (const auto& time : times_outside) {
    for (const auto& part : contact_parts(own, time)) {
      if (!all_outside(part, facts.candidates(s))) continue;
      premise_held = true;
      const bool earlier = std::any_of(part.begin(), part.end(), [&](const PairContact& contact) {
        return first_of[at(contact.pair.a)] < time || first_of[at(contact.pair.b)] < time;
      });
      if (!earlier) {
        return fmt::format("the place of ({}, {}) is outside K and nothing there met before {}",
                           part[0].pair.a, part[0].pair.b, time.lo);
      }
    }
  }
  return premise_held ? holds() : not_met();
}

constexpr Law first_contact_law_table[] = {
    {"L3_FirstContactIsACandidate", "L3",
     "At the first contact time every place of contact (connected part of the contact graph) has a "
     "pair in K = (V+,V-) u (U,V0) u (U,Vv), pairs of two components included.",
     "pair set, view signs", each_step<first_contact_is_a_candidate>},
    {"L6_OutsideKSomethingMetBefore", "L6",
     "Where all contacting pairs of a place are outside K, a triangle there was in contact "
     "strictly earlier.",
     "pair set, view signs", each_step<outside_k_something_came_before>},
};

}  // namespace

std::span<const Law> first_contact_laws() { return first_contact_law_table; }

}  // namespace assay::properties
