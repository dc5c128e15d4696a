// L3, L6 and L7: which contacts of a step are in K, which pairs K may leave out, and which pairs
// the closure adds. Also the claims of the detector. L13 and L14: pairs that normal cones may leave
// out.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "properties/judging/agreement.h"
#include "properties/laws/step_law.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

namespace {

bool all_outside(const ContactPart& part, const oracle::Candidates& k) {
  return std::ranges::none_of(part,
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

// Looks only at contacts inside a component, because all pairs of two components are in K and make
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
      const bool earlier = std::ranges::any_of(part, [&](const PairContact& contact) {
        return first_of[at(contact.pair.a)] < time || first_of[at(contact.pair.b)] < time;
      });
      if (!earlier) {
        return fmt::format("the place of ({}, {}) is outside K, and nothing met there before {}",
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
     "If all pairs in contact at a place are outside K, a triangle at this place was in contact "
     "strictly earlier.",
     "pair set, view signs", each_step<outside_k_something_came_before>},
};

}  // namespace

std::span<const Law> first_contact_laws() { return first_contact_law_table; }

// L7, and the claims of the detector: its pairs and times are compared with those of the oracle.

namespace {

Observation closure_is_the_pair_set(CaseFacts& facts, std::size_t s) {
  if (!facts.is_judged(s) || !facts.is_trusted(s)) return not_met();
  const auto& ours = facts.result(s);
  const auto& theirs = facts.judgement(s).pairs;
  if (!is_answered(ours) || facts.options().pairs != detector::Pairs::all) return not_met();
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
  return fmt::format("{} pairs of {}; ({}, {}) is missing, spurious, or has a wrong time",
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
    return holds_if(is_answered(result), "no answer to a valid step");
  }
  const auto& judgement = facts.judgement(s);
  if (!judgement.complete || result.answer == Answer::error) return not_met();
  const bool contact = !judgement.pairs.empty();
  const bool about_contacts = claim != Claim::free_sound && claim != Claim::no_spurious;
  if (about_contacts && !contact) return not_met();
  if (claim == Claim::free_sound && result.answer != Answer::free && !contact) return not_met();
  const auto diff = compare(result, judgement, claims_of(facts.options()));
  const bool is_broken = std::ranges::count(diff.breaches, claim) != 0;
  return holds_if(!is_broken, "refuted");
}

constexpr Law pair_set_law_table[] = {
    {"L7_ClosureIsThePairSet", "L7",
     "The closure of K gives the complete pair set of the step: the oracle's pairs, each with its "
     "first time to the last bit.",
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
    {"Claim_AllPairs", "claim", "Every pair in contact is reported, and not too late.", "pair set",
     each_step<claim_holds<Claim::all_pairs>>},
    {"Claim_NoSpurious", "claim", "No pair, time or collision is reported before its contact.",
     "pair set", each_step<claim_holds<Claim::no_spurious>>},
    {"Claim_Total", "claim", "Every valid step is answered.", "nothing",
     each_step<claim_holds<Claim::total>>},
};

}  // namespace

std::span<const Law> pair_set_laws() { return pair_set_law_table; }

// L13 and L14: patches that face one direction and have a simple contour, and the search that
// rests on them.

namespace {

// Returns whether the step is judged and some patch of two triangles or more is certified.
bool has_certified_patch(CaseFacts& facts, std::size_t s) {
  return facts.is_judged(s) && facts.traditional_scheme() && facts.certified_patches(s).largest > 1;
}

bool is_nearly_edge_on(CaseFacts& facts, std::size_t s) {
  return is_close(facts.certified_patches(s).facing);
}

Observation certified_patches_are_free(CaseFacts& facts, std::size_t s) {
  if (!has_certified_patch(facts, s)) return not_met();
  for (const auto& contact : facts.judgement(s).pairs) {
    if (!facts.certified_patches(s).hold(contact.pair)) continue;
    return fmt::format("triangles {} and {} are in contact in a patch that is certified free",
                       contact.pair.a, contact.pair.b);
  }
  return holds();
}

// Observes that every contact is a candidate. This asks more than the claim of all pairs, because a
// pair that the search leaves out may still be found by a feature that another pair of triangles
// shares.
Observation every_contact_is_a_candidate(CaseFacts& facts, std::size_t s) {
  if (!has_certified_patch(facts, s) || facts.judgement(s).pairs.empty()) return not_met();
  const auto candidates = facts.traditional_scheme()->candidates({facts.x_t0(s), facts.x_t1(s)});
  for (const auto& contact : facts.judgement(s).pairs) {
    if (candidates.count(contact.pair)) continue;
    return fmt::format("({}, {}) is in contact, and the search by normal cones leaves it out",
                       contact.pair.a, contact.pair.b);
  }
  return holds();
}

// The search of a detector, made to ask for proofs wherever they are not hopeless. The law is about
// the pairs that proofs leave out, and not about when proofs pay.
class EagerMeshSearch : public detector::MeshSearch {
 public:
  EagerMeshSearch(const detector::PairSearch& by, std::unique_ptr<detector::MeshSearch> search)
      : MeshSearch(by), search_(std::move(search)) {}
  bool fit(detector::BoundingVolumeTree& tree, const detector::Topology& mesh,
           const SteppedMesh& motion, detector::PacedStop& pace) override {
    return search_->fit(tree, mesh, motion, pace);
  }
  bool search(const detector::SearchInput& input, detector::SearchCounts& counts,
              const detector::PairSink& sink) override {
    return search_->search(input, counts, sink);
  }
  detector::ProvableShares provable_shares(const detector::Topology&) const override {
    return {1, 1, 1};
  }

 private:
  std::unique_ptr<detector::MeshSearch> search_;
};

class EagerProofs : public detector::PairSearch {
 public:
  explicit EagerProofs(std::shared_ptr<const detector::PairSearch> search)
      : search_(std::move(search)) {}
  std::unique_ptr<detector::MeshSearch> prepare(const detector::Topology& mesh,
                                                const detector::BoundingVolumeTree& tree,
                                                detector::PacedStop& pace) const override {
    return std::make_unique<EagerMeshSearch>(*this, search_->prepare(mesh, tree, pace));
  }
  bool search(const detector::SearchInput& input, detector::SearchCounts& counts,
              const detector::PairSink& sink) const override {
    return search_->search(input, counts, sink);
  }

 private:
  std::shared_ptr<const detector::PairSearch> search_;
};

std::string left_out(const StepResult& result, const StepJudgement& judgement) {
  std::set<TrianglePair> pairs;
  for (const auto& contact : result.pairs) pairs.insert(contact.pair);
  for (const auto& contact : judgement.pairs) {
    if (!pairs.contains(contact.pair))
      return fmt::format("({}, {}) is in contact, and was left out", contact.pair.a,
                         contact.pair.b);
  }
  return {};
}

// Checks that K without N holds the contacts of L3 and L7 as well.
void check_what_is_proved(CaseFacts& facts, LawTally& tally) {
  const auto& options = facts.options();
  if (options.culling != Culling::automatic || options.pairs != detector::Pairs::all ||
      options.arithmetic != Arithmetic::exact)
    return;
  auto stages = facts.stages_of()(options);
  stages.pair_search = std::make_shared<EagerProofs>(stages.pair_search);
  auto eager = CasePlayer::make(facts.source(), options, std::move(stages));
  if (!eager) return;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto result = eager.value().play(s);
    Observation finding = not_met();
    if (has_certified_patch(facts, s) && result.counts.search.contour_tests > 0) {
      finding = left_out(result, facts.judgement(s));
      if (finding->empty()) finding = left_out(facts.result(s), facts.judgement(s));
    }
    note(facts, s, finding, tally, is_nearly_edge_on);
  }
}

constexpr Law normal_cone_law_table[] = {
    {"L13_CertifiedPatchesAreFree", "L13",
     "If throughout a step all triangles of a patch face one direction and the patch's contour, "
     "projected along this direction, stays a simple polygon, no two of them are in contact.",
     "pair set", each_step<certified_patches_are_free, is_nearly_edge_on>},
    {"L13_EveryContactIsACandidate", "L13",
     "In a step with patches that are free by L13 the search by normal cones leaves these out, and "
     "still finds every pair in contact.",
     "pair set", each_step<every_contact_is_a_candidate, is_nearly_edge_on>},
    {"L14_NoContactIsAmongWhatIsProved", "L14",
     "With views or without, `--culling auto` leaves out the pairs that normal cones and contours "
     "prove apart, and still finds every pair in contact.",
     "pair set", check_what_is_proved},
};

}  // namespace

std::span<const Law> normal_cone_laws() { return normal_cone_law_table; }

}  // namespace assay::properties
