// L13 and L14: patches that face one direction and have a simple contour, and the search that
// rests on them.
#include <fmt/format.h>

#include <set>

#include "properties/laws/step_law.h"
#include "properties/worker/case_run.h"

namespace assay::properties {
namespace {

// Whether the step is judged and some patch of two triangles or more is certified.
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

// This asks more than the claim of all pairs, because a pair that the search leaves out may still
// be found by a feature that another pair of triangles shares.
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

// The search of a detector, made to ask for proofs wherever they are not hopeless. The law is
// about what the proofs leave out, and not about when they pay.
class EagerMeshSearch : public detector::MeshSearch {
 public:
  EagerMeshSearch(const detector::PairSearch& by, std::unique_ptr<detector::MeshSearch> search)
      : MeshSearch(by), search_(std::move(search)) {}
  bool fit(detector::BoundingVolumeTree& tree, const detector::Topology& mesh,
           const detector::SteppedMesh& motion, detector::PacedStop& pace) override {
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

std::string left_out(const detector::StepResult& result, const oracle::StepJudgement& judgement) {
  std::set<detector::TrianglePair> found;
  for (const auto& contact : result.pairs) found.insert(contact.pair);
  for (const auto& contact : judgement.pairs) {
    if (!found.contains(contact.pair))
      return fmt::format("({}, {}) is in contact, and was left out", contact.pair.a,
                         contact.pair.b);
  }
  return {};
}

// Checks that K without N holds the contacts of L3 and L7 as well.
void check_what_is_proved(CaseFacts& facts, LawTally& tally) {
  const auto& options = facts.options();
  if (options.culling != detector::Culling::automatic || options.pairs != detector::Pairs::all ||
      options.arithmetic != detector::Arithmetic::exact)
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
     "No two triangles of a patch are in contact in a step throughout which all of its triangles "
     "face one direction and its contour, projected along it, stays a simple polygon.",
     "pair set", each_step<certified_patches_are_free, is_nearly_edge_on>},
    {"L13_EveryContactIsACandidate", "L13",
     "In a step with such a patch the search by normal cones, which leaves patches out, still "
     "comes to every pair in contact.",
     "pair set", each_step<every_contact_is_a_candidate, is_nearly_edge_on>},
    {"L14_NoContactIsAmongWhatIsProved", "L14",
     "In a step of culling auto that leaves out what normal cones and contours prove apart, with "
     "views or without, every pair in contact is found.",
     "pair set", check_what_is_proved},
};

}  // namespace

std::span<const Law> normal_cone_laws() { return normal_cone_law_table; }

}  // namespace assay::properties
