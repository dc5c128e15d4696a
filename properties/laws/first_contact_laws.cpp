// L3, L6 and L7: what K holds of the contacts of a step, what it may leave out, and what the
// closure adds; and the claims of the detector.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "properties/judging/agreement.h"
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

// L7, and the claims of the detector: its pairs and times are compared with those of the oracle.

namespace {

using detector::Answer;

Observation closure_is_the_pair_set(CaseFacts& facts, std::size_t s) {
  if (!facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  const auto& ours = facts.result(s);
  const auto& theirs = facts.judgement(s).pairs;
  const bool answered = ours.answer == Answer::free || ours.answer == Answer::collision;
  if (!answered || facts.options().pairs != detector::Pairs::all) return not_met();
  if (ours.pairs.empty() && theirs.empty()) return not_met();
  const auto [mine, other] =
      std::mismatch(ours.pairs.begin(), ours.pairs.end(), theirs.begin(), theirs.end(),
                    [](const PairContact& a, const PairContact& b) {
                      return a.pair == b.pair && a.time == b.time;
                    });
  if (mine == ours.pairs.end() && other == theirs.end()) return holds();
  const auto& pair = other == theirs.end()                                  ? mine->pair
                     : mine != ours.pairs.end() && mine->pair < other->pair ? mine->pair
                                                                            : other->pair;
  return fmt::format("{} pairs of {}; ({}, {}) is missing, spurious, or has another time",
                     ours.pairs.size(), theirs.size(), pair.a, pair.b);
}

// Checks one claim of the built-in detector. In a step that the oracle did not finish, the premise
// does not hold.
template <Claim claim>
Observation claim_holds(CaseFacts& facts, std::size_t s) {
  const auto& result = facts.result(s);
  const Claims claims = claims_of(facts.options());
  if (!claims.has(claim) || !facts.is_trusted(s)) return not_met();
  if (claim == Claim::total) {
    return holds_if(result.answer == Answer::free || result.answer == Answer::collision,
                    "no answer to a valid step");
  }
  const auto& judgement = facts.judgement(s);
  if (!judgement.complete || result.answer == Answer::error) return not_met();
  const bool contact = !judgement.pairs.empty();
  const bool about_contacts = claim != Claim::free_sound && claim != Claim::no_spurious;
  if (about_contacts && !contact) return not_met();
  if (claim == Claim::free_sound && result.answer != Answer::free && !contact) return not_met();
  const auto diff = compare(result, judgement, claims_of(facts.options()));
  const bool broken = std::count(diff.broken.begin(), diff.broken.end(), claim) != 0;
  return holds_if(!broken, "refuted");
}

constexpr Law pair_set_law_table[] = {
    {"L7_ClosureIsThePairSet", "L7",
     "K closed over what it finds is the complete pair set of the step: the oracle's pairs, and "
     "each first time in every bit.",
     "pair set", each_step<closure_is_the_pair_set>},
    {"Claim_FreeSound", "claim", "Free is never answered when there is a contact.", "pair set",
     each_step<claim_holds<Claim::free_sound>>},
    {"Claim_NotLate", "claim", "The first time answered is not after the first contact.",
     "pair set", each_step<claim_holds<Claim::not_late>>},
    {"Claim_FirstTime", "claim", "The first time answered is that of the first contact.",
     "pair set", each_step<claim_holds<Claim::first_time>>},
    {"Claim_FirstPairs", "claim",
     "Every place of the first contact (connected part of the contact graph) has a reported pair.",
     "pair set", each_step<claim_holds<Claim::first_pairs>>},
    {"Claim_AllPairs", "claim", "Every pair in contact is reported, none with a later time.",
     "pair set", each_step<claim_holds<Claim::all_pairs>>},
    {"Claim_NoSpurious", "claim", "No pair, time or collision is reported before there is one.",
     "pair set", each_step<claim_holds<Claim::no_spurious>>},
    {"Claim_Total", "claim", "Every valid step is answered.", "nothing",
     each_step<claim_holds<Claim::total>>},
};

}  // namespace

std::span<const Law> pair_set_laws() { return pair_set_law_table; }

}  // namespace assay::properties
