// Culling automatic and view_auto: from where a step is looked at, whether its views are worth
// using, and whether patches are worth proving apart in its search (automatic alone).
//
// Everything is decided from the numbers of triangles and pairs of this step and of the steps
// committed before, never from a clock: same input, same bytes. What is decided is a matter of
// cost alone. The primitive may be anywhere (L3), so another one may serve in each step; a step
// without views tests every pair, which finds the complete pair set whatever is dirty.
//
// The unit of cost is a candidate pair of culling bvh, all that it takes included (box tests, axis
// order, elementary tests, its share of the refit): 0.15 to 0.2 us.
#pragma once

#include <optional>

#include "detector/state/view_choice.h"
#include "detector/step/step_work.h"
#include "detector/step_result.h"

namespace assay::detector {

// Pairs of triangles that share a vertex: candidates of culling bvh in every step, for their boxes
// touch. O(M).
std::uint64_t adjacent_pairs(const Topology& mesh);

class ViewAuto {
 public:
  // adjacent: of the mesh. The references must outlive this object.
  ViewAuto(const Surface& surface, std::uint64_t adjacent, const ViewChoice& before)
      : surface_(surface), adjacent_(adjacent), choice_(before) {}

  // Whether this step is looked at. After looks that did not pay, 1, 2, 4 .. 32 steps are not.
  bool looks() const { return choice_.rest == 0; }
  // Whether a look at a few triangles of the large components, in doubles alone, leaves hope: where
  // few of them have a sign that doubles can tell, as on a sheet seen along itself, the view test
  // costs more than the rest of the step, for integers decide it.
  bool glances(const StepWork& work);

  // Where a component is looked at from; `first`: of preprocessing. Chooses again, from the
  // positions where the step starts, what has ceased to pay.
  const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first,
                                         const PositionsView& x_t0, PacedStop& pace);

  // Whether the signs leave out enough pairs, should all triangles be clean, to be worth what else
  // views took when last used, and the ghosts are few enough to be swept. Refits the tree of an
  // unclosed mesh.
  bool promises(StepWork& work);
  // Whether enough is left once it is known what is clean. Where nothing was known of the start,
  // and too little is left, nothing is said against views in the next step.
  bool pays(const StepWork& work);
  // What the release, the sweep and the closure have cost is held against what was saved.
  // `candidates_of_k`: those before the closure.
  void weigh(const StepCounts& counts, std::uint64_t candidates_of_k);

  // Whether normal cones and contours are worth their cost in the search of this step (L14).
  // asked: of pairs of neighbours, the share that K asks for.
  bool proofs_pay(const ProvableShares& provable, double asked, std::size_t triangles);

  // Whether views are used, as far as that is decided.
  ViewUse use() const { return looks() ? use_ : ViewUse::resting; }

  // For the steps that follow. own: the detector's own primitives were used, not the caller's.
  ViewChoice after(const StepCounts& counts, bool own) const;

 private:
  // Of a step that does without views because they would not pay; returns false.
  bool does_without(ViewUse because);
  std::uint64_t expected_candidates() const;
  double cost_beside_k(const StepCounts& counts) const;

  const Surface& surface_;
  std::uint64_t adjacent_;
  ViewChoice choice_;
  bool chose_ = false;
  double share_of_signs_ = 1, share_ = 1;  // a free step saves all
  bool paid_ = true;
  bool proves_ = false;
  ViewUse use_ = ViewUse::used;
  std::optional<double> overhead_;  // of this step
};

}  // namespace assay::detector
