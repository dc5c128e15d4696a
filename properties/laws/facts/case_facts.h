// What the laws ask of one case in one configuration: the detector's results, and beside them the
// oracle's view of the same steps. Each fact is computed when it is first asked for, once.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/detector.h"
#include "detector/step/stages.h"
#include "detector/traditional/traditional.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/step.h"
#include "oracle/view/view_sign.h"
#include "properties/laws/facts/view_values.h"
#include "properties/numbering.h"

namespace assay::properties {

// The patches of a step that the traditional scheme certifies, found by the scheme's own tests.
//
// A patch is certified when L13's premise is proved of it: all of its triangles face one direction
// throughout the step, and its contour, projected along that direction, stays a simple polygon.
// The patches looked at are nodes of the detector's tree, from the root down to the largest ones
// that are certified, and unions of two of these that share an edge. A scheme that is wrong in one
// of its tests certifies too much here as well, and L13 shows it.

struct CertifiedPatches {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> patch_of;  // by triangle; none: the triangle faces no direction
  std::set<std::pair<std::int32_t, std::int32_t>> unions;  // of two patches, the lower one first
  // How many triangles the largest patch or union has. From 2 on L13 says something.
  std::size_t largest = 0;
  // A triangle faces d when the three Bernstein coefficients of N.d over the step are positive (N
  // its normal, twice its area long). These are the sizes of the coefficients, for the direction
  // of the patch and all of its triangles, over all patches and unions of two triangles or more.
  ValueRange facing;

  // Whether both triangles are in one patch, or in one union of two.
  bool hold(const detector::TrianglePair& pair) const;
};

// The traditional scheme on one mesh.
class TraditionalScheme {
 public:
  // Null if the search of these stages is not one of normal cones. `x` are the positions that the
  // detector is made from: they shape the tree. `mesh` must outlive the result.
  static std::unique_ptr<TraditionalScheme> make(const detector::Stages& stages,
                                                 const detector::Topology& mesh,
                                                 const detector::PositionsView& x);

  // The patches that are certified in this step. As dear as a step of the scheme: 10 us for 20
  // triangles.
  CertifiedPatches certify(const detector::SteppedMesh& motion) const;

  // The pairs of triangles that the scheme's search of this step does not leave out.
  std::set<detector::TrianglePair> candidates(const detector::SteppedMesh& motion);

 private:
  class PatchFinder;
  TraditionalScheme(std::shared_ptr<const detector::NormalConeSearch> search,
                    const detector::Topology& mesh, const detector::PositionsView& x);

  std::shared_ptr<const detector::NormalConeSearch> search_;
  const detector::Topology& mesh_;
  detector::BoundingVolumeTree tree_;
  std::unique_ptr<detector::ContourMaker> maker_;
  detector::PatchContours contours_;
};

inline bool is_answered(const detector::StepResult& result) {
  return result.answer == detector::Answer::free || result.answer == detector::Answer::collision;
}

// How a law makes a detector of its own, to run a changed case. Empty if the results come from a
// detector that cannot be made here (a plug-in); the premises of laws that need one are then not
// met.
using StagesOf = std::function<detector::Stages(const detector::Options&)>;

class CaseFacts {
 public:
  // REQUIRES valid input, one result and one judgement for each step of the case, and the surface
  // of the detector that gave the results. All of them outlive this object.
  CaseFacts(const corpus::Case& source, const detector::Options& options,
            std::span<const detector::StepResult> results,
            std::span<const oracle::StepJudgement> judgements, const detector::Surface& surface,
            StagesOf stages_of = detector::standard_stages);
  ~CaseFacts();

  // The case and its steps.
  const corpus::Case& source() const { return source_; }
  const detector::Options& options() const { return options_; }
  const detector::Surface& surface() const { return surface_; }
  const StagesOf& stages_of() const { return stages_of_; }
  std::size_t steps() const { return script_.size(); }
  const corpus::CaseStep& script(std::size_t s) const { return script_[s]; }
  const detector::Positions& x_t0(std::size_t s) const { return start_of(source_, script_[s]); }
  const detector::Positions& x_t1(std::size_t s) const { return end_of(source_, script_[s]); }
  const detector::StepResult& result(std::size_t s) const { return results_[s]; }
  const oracle::StepJudgement& judgement(std::size_t s) const { return judgements_[s]; }
  std::int32_t component_of(std::int32_t triangle) const {
    return surface_.mesh.component_of_triangle[static_cast<std::size_t>(triangle)];
  }

  // The committed step at whose end step s starts; nothing if step s is a new start.
  const std::optional<std::size_t>& known_from(std::size_t s) const { return known_from_[s]; }
  // The detector answered step s and the result states its view sets.
  bool has_views(std::size_t s) const;
  bool has_ghosts(std::size_t component) const;
  // Some edge has three or more triangles, or is used twice in one direction.
  bool has_broken_edges() const;
  // The detector verifies a new start by views alone (L5), as under view-auto, and not by layers
  // (L9).
  bool starts_by_view_alone() const;
  // The oracle finished this step.
  bool is_judged(std::size_t s) const { return judgements_[s].complete; }
  // The premise of L3 to L8: outside Vv everything is clean at the start. If the caller vouched
  // for a new start (start clean), the oracle's layers decide whether that is true. In all other
  // cases the detector itself answers for what it takes as clean, which L8 and L9 judge.
  bool is_trusted(std::size_t s);

  // The functions below ask the oracle, and take the primitives and apexes from the detector's
  // result. S is a component with its ghosts, K the set of candidates. REQUIRES has_views(s).
  const std::vector<detector::ViewSign>& signs(std::size_t s);  // mesh, then ghosts
  const std::vector<std::uint8_t>& touched(std::size_t s);      // by the component's ghosts (L11)
  const oracle::Candidates& candidates(std::size_t s);          // K
  std::optional<int> winding_at_start(std::size_t s, std::size_t component);  // of q0, in S
  // L5 over the step: all triangles of the component and its ghosts are positive throughout, and
  // the winding number is 1 at t=0.
  bool is_free_by_view(std::size_t s, std::size_t component);
  const oracle::LayerState& layers_at_start(std::size_t s);
  const oracle::LayerState& layers_at_end(std::size_t s);
  // By triangle; 1: in contact with another triangle of its component. REQUIRES is_judged(s).
  const std::vector<std::uint8_t>& own_contacts(std::size_t s);

  bool same_component(const detector::TrianglePair& pair) const {
    return component_of(pair.a) == component_of(pair.b);
  }
  bool in_doubt(std::size_t s, std::int32_t triangle) const {
    return results_[s].doubts[static_cast<std::size_t>(triangle)] != 0;
  }

  // The range of the view values of the step, computed in doubles. `is_close` judges closeness by
  // it, and is false if the step has no views.
  const ValueRange& view_range(std::size_t s);
  bool is_close(std::size_t s);

  // The traditional scheme that stages_of() makes, on the mesh of this case; null if it makes
  // none. It is the same whatever culling gave the results.
  TraditionalScheme* traditional_scheme();
  // The patches that this scheme's own tests certify. REQUIRES traditional_scheme().
  const CertifiedPatches& certified_patches(std::size_t s);

  // Positions at the step's start and end. Rows: vertices of the mesh, then apexes.
  detector::Positions all_t0(std::size_t s) const;
  detector::Positions all_t1(std::size_t s) const;
  const detector::Triangles& ghosts() const { return ghosts_; }

 private:
  struct StepFacts;
  const oracle::LayerState& layers_of(const detector::Positions& all);

  const corpus::Case& source_;
  detector::Options options_;
  std::span<const detector::StepResult> results_;
  std::span<const oracle::StepJudgement> judgements_;
  const detector::Surface& surface_;
  StagesOf stages_of_;
  std::vector<corpus::CaseStep> script_;
  std::vector<std::optional<std::size_t>> known_from_;
  detector::Triangles ghosts_;
  std::vector<StepFacts> facts_;
  std::optional<std::unique_ptr<TraditionalScheme>> traditional_scheme_;
  // Found by positions, because the end of one step is the start of the next.
  std::vector<std::pair<detector::Positions, std::unique_ptr<oracle::LayerState>>> layers_;
};

// The view sets of a pair's two triangles (L3, detector/LAWS.md). A triangle in Vv counts as
// violated, whatever its sign.
enum class PairBlock : std::uint8_t {
  positive_negative,
  positive_zero,
  negative_zero,
  zero_zero,
  violated,  // at least one triangle is in Vv
  positive_positive,
  negative_negative,  // the last two are outside K, unless in two groups
};
constexpr auto names_of(PairBlock) {
  using enum PairBlock;
  return std::to_array<Named<PairBlock>>({{positive_negative, "V+ V-"},
                                          {positive_zero, "V+ V0"},
                                          {negative_zero, "V- V0"},
                                          {zero_zero, "V0 V0"},
                                          {violated, "Vv any"},
                                          {positive_positive, "V+ V+"},
                                          {negative_negative, "V- V-"}});
}
PairBlock block_of(detector::ViewSign a, detector::ViewSign b, bool either_violated);

}  // namespace assay::properties
