// Answers the questions that a step asks of its culling: whether it is seen from view primitives,
// whether it goes on with the signs found there, and whether patches are worth proving apart.
//
// Every answer is a matter of cost alone, so a policy cannot make a step wrong: a step without
// views tests every pair, and a proof leaves out pairs that are not in contact (L14). A step asks
// in the order of the functions below. After the first no the step does without views.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "detector/options.h"
#include "detector/search/candidate_search.h"
#include "detector/state/step_state.h"
#include "detector/step/release_rule.h"
#include "detector/step/step_work.h"
#include "detector/step_result.h"

namespace assay::detector {

// How a verified start finds out which triangles are clean: by view (L5) and then by layers (L9),
// or by view alone.
enum class StartBy : std::uint8_t { view_and_layers, view_alone };

class CullingPolicy {
 public:
  virtual ~CullingPolicy() = default;

  // Returns whether steps of this culling may have views. Then each step keeps track of clean
  // triangles, so that a later step with views can rely on that.
  virtual bool may_use_views() const = 0;
  // Is called first, with the motion of the mesh, the state that the step goes on from (or null),
  // and whether the step would need the views that the detector makes (FirstViews).
  virtual void begin(const SteppedMesh&, const StepState*, bool) {}
  // Returns whether view primitives are placed in this step.
  virtual bool is_due() const = 0;
  // Returns how much work making views may take, in box tests. pay_for_views is called afterwards
  // with whether they are made, and the work done. If they are not made, the step does without
  // views.
  virtual double most_for_views() const { return std::numeric_limits<double>::infinity(); }
  virtual void pay_for_views(bool /*are_made*/, double /*work*/) {}
  // Returns the places that components are seen from. `first`: the anchors of preprocessing.
  virtual const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first,
                                                 const PositionsView& vertices_t0,
                                                 PacedStop& pace) = 0;
  // Returns whether the triangles are classified. REQUIRES that primitives are placed.
  virtual bool worth_classifying(const GivenStep& step, const StepMarks& marks) = 0;
  // Returns whether the ghosts are swept. REQUIRES that the triangles are classified.
  virtual bool worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) = 0;
  // Returns how to find out which triangles are clean at the start.
  virtual StartBy start_by() const = 0;
  // Returns whether the search uses views. REQUIRES that it is known which triangles are clean.
  // `counts`: those of the step so far.
  virtual bool worth_using(const GivenStep& step, const StepMarks& marks,
                           const StepCounts& counts) = 0;

  // Returns whether the search proves patches apart. REQUIRES that types are marked.
  virtual bool worth_proving(const StepMarks& marks, CandidateSearch& candidates) = 0;
  // Is called after a search with views, unless a first contact has cut it short.
  // `candidates_of_k`: the number of candidates before the closure.
  virtual void record_cost(const StepCounts& counts, std::uint64_t candidates_of_k) = 0;

  // Returns whether views were used, as far as that is decided.
  virtual ViewUse use() const = 0;
  // Returns the state that the policy of the next step begins with. `contacts`: how many pairs are
  // in contact. After a search that a first contact has cut short, it is 0, and so are the counts
  // of the search, because they depend on the tree. has_own_primitives: the primitives were placed
  // at the policy's anchors; otherwise the caller gave them.
  virtual PolicyState next(const StepCounts& counts, std::size_t contacts,
                           bool has_own_primitives) const = 0;
};

// The cullings that decide nothing: views always (view_point, view_line) or never.
class FixedPolicy : public CullingPolicy {
 public:
  FixedPolicy(Culling culling, PolicyState before)
      : has_views_(uses_views(culling)), state_(std::move(before)) {}

  bool may_use_views() const override { return has_views_; }
  bool is_due() const override { return has_views_; }
  const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first, const PositionsView&,
                                         PacedStop&) override {
    return first;
  }
  bool worth_classifying(const GivenStep&, const StepMarks&) override { return true; }
  bool worth_sweeping(const GivenStep&, const StepMarks&, PacedStop&) override { return true; }
  StartBy start_by() const override { return StartBy::view_and_layers; }
  bool worth_using(const GivenStep&, const StepMarks&, const StepCounts&) override { return true; }
  bool worth_proving(const StepMarks&, CandidateSearch&) override { return true; }
  void record_cost(const StepCounts&, std::uint64_t) override {}
  ViewUse use() const override { return has_views_ ? ViewUse::used : ViewUse::not_asked_for; }
  PolicyState next(const StepCounts&, std::size_t, bool) const override { return state_; }

 private:
  bool has_views_;
  PolicyState state_;
};

// Returns the number of pairs of triangles that share a vertex. Culling bvh has them as candidates
// in every step, because their boxes touch. O(M).
std::uint64_t adjacent_pairs(const Topology& mesh);

// The policy of Culling::automatic and view_auto: a cost model of views and of proofs.
//
// It weighs the expected saving of views against their expected cost. Both are computed from the
// numbers of triangles and pairs of this step and of the steps committed before, never from a
// clock: the same input gives the same bytes. A step may be seen from anywhere (L3), so each step
// may have primitives of its own.
//
// The unit of cost is one candidate pair of Culling::bvh with all that belongs to it (box tests,
// axis order, elementary tests, its share of the refit): 0.15 to 0.2 us.
//
// From step to step the model is in one of two states, and the first step finds views due:
//
//   state          event               next state
//   views are due  views pay           views are due; next_pause is halved, to 1 at least
//   views are due  views do not pay    a pause of next_pause steps; that doubles, to 32 at most
//   pause          its last step ends  views are due
//
// When views are due, anchors are chosen again first if they are worn: they have served for
// least_anchor_age steps, and either views did not pay or the share of pairs that they save has
// fallen by an eighth from its best.
//
// A step after one in which most triangles were in contact does not try to release them: they will
// likely be in contact again. Then views do not pay either.
//
// In addition, `automatic` keeps an account of counted work in box tests (work_of_candidate
// and the constants beside it; the benches account/ hold it against times). Each step without views
// earns a share of its work. A step with views earns the least amount of work that `bvh` would have
// needed in addition, and pays for the work of views. Views are made and tried only if they can be
// paid for. So after any number of steps, `automatic` has spent little more than `bvh` would have
// spent. If a glance from the middle of the mesh shows it to be positive, the step may spend
// in advance the saving of views within it. If only the first contact of the last step is known,
// the start would have to be verified anew. That costs more than views save, so such a step does
// without views. Work that depends on the tree is not counted, so that a restored detector, whose
// tree is another one, decides alike. A mesh at rest earns nothing.
//
// Example: on a sheet seen along itself views do not pay in steps 1, 3, 6, 11, 20; the pauses
// between these are of 1, 2, 4 and 8 steps.
class CostModel : public CullingPolicy {
 public:
  // The share of its work that a step without views earns; README.md allows twice this loss.
  static constexpr double earned_share = 0.05;

  // adjacent: adjacent_pairs of the mesh. The surface must outlive this object.
  // saves_up: keeps an account of work, as only Culling::automatic does.
  CostModel(const Surface& surface, std::uint64_t adjacent, PolicyState before,
            bool saves_up = false)
      : surface_(surface), adjacent_(adjacent), state_(std::move(before)), saves_up_(saves_up) {}

  bool may_use_views() const override { return true; }
  void begin(const SteppedMesh& motion, const StepState* last_state, bool needs_views) override;
  // Returns whether views are due: no pause lasts, and they cost no more than may be spent.
  bool is_due() const override { return state_.pause == 0 && !waits_; }
  double most_for_views() const override;
  void pay_for_views(bool are_made, double work) override;
  // Chooses anchors again when they are due, from the positions at the start of the step.
  const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first,
                                         const PositionsView& vertices_t0,
                                         PacedStop& pace) override;

  // Classifies a few triangles of each large component, in doubles alone. Returns false if doubles
  // can tell few of their signs, as on a sheet that is seen along itself: integers would have to
  // decide the others, and the view test would cost more than the rest of the step.
  bool worth_classifying(const GivenStep& step, const StepMarks& marks) override;
  // Returns whether the signs would save enough if all triangles were clean, and few enough
  // triangles are near ghosts. Refits the tree of an unclosed mesh.
  bool worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) override;
  // Leaves out layers, which cost about as much as a step of Culling::bvh.
  StartBy start_by() const override { return StartBy::view_alone; }
  // Returns whether the signs save enough among the triangles that are clean. The answer false
  // begins a pause, unless nothing was known of the start.
  bool worth_using(const GivenStep& step, const StepMarks& marks,
                   const StepCounts& counts) override;

  bool worth_proving(const StepMarks& marks, CandidateSearch& candidates) override;
  // Returns whether normal cones and contours are expected to save more than they cost (L14).
  // asked_share: the share of pairs of neighbours that K asks for and that fans leave open.
  bool worth_proving(const ProvableShares& provable, double asked_share, std::size_t triangles);

  // Notes whether views have paid: release, ghost sweep and closure cost less than the pairs that
  // views left out.
  void record_cost(const StepCounts& counts, std::uint64_t candidates_of_k) override;

  ViewUse use() const override {
    return state_.pause > 0 ? ViewUse::resting : waits_ ? ViewUse::saving_up : use_;
  }
  PolicyState next(const StepCounts& counts, std::size_t contacts,
                   bool has_own_primitives) const override;

 private:
  // Notes that views would not pay in this step, and why. Returns false.
  bool does_without(ViewUse because);
  std::uint64_t expected_candidates() const;
  // Returns the cost of release and ghost sweep, in candidates.
  double cost_beside_search(const StepCounts& counts) const;
  void update_anchors(PolicyState& next) const;
  // Estimates the saving of views within a step that is seen from the middle of its components.
  double hoped_at_a_glance(const SteppedMesh& motion) const;
  // Returns whether the work of bvh can be computed from the counts of the search. It cannot if
  // proofs, or the sheets of a mesh at rest, leave out pairs: these pairs depend on the tree, and
  // so on the positions that the detector was made from.
  bool counts_tell() const { return !proves_ && !is_at_rest_; }
  // Returns how much may be spent after this step.
  double credit_after(const StepCounts& counts, std::size_t contacts) const;

  const Surface& surface_;
  std::uint64_t adjacent_;
  PolicyState state_;
  bool chose_anchors_ = false;
  double share_of_signs_ = 1;  // the share of pairs that the signs save if all triangles are clean
  double share_ = 1;           // as above, with the triangles known to be clean; 1 in a free step
  bool paid_ = true;
  bool proves_ = false;
  ViewUse use_ = ViewUse::used;
  std::optional<double> overhead_;  // of this step, where views were used or found not worth using

  bool saves_up_ = false, waits_ = false, is_at_rest_ = false;
  double most_for_views_ = 0;
  double spent_ = 0;                   // of this step, on views and on the view test, in box tests
  std::optional<std::uint64_t> of_k_;  // candidates before the closure, once known
};

}  // namespace assay::detector
