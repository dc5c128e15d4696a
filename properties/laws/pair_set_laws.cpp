// L7, and the claims of the detector: its pairs and times are compared with those of the oracle.
#include <fmt/format.h>

#include <algorithm>

#include "properties/judging/agreement.h"
#include "properties/laws/law_groups.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::Answer;
using detector::PairContact;

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
  const auto diff = compare(result, judgement, facts.options());
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
