// Decides how a step culls: whether triangles are classified from view primitives, whether the
// search uses their signs, and whether patches are worth proving apart.
//
// These decisions affect only the cost, so a policy cannot make a step wrong: a step without views
// tests every pair, and a proof leaves out only pairs that are not in contact (L14). A step calls
// the functions in the order below. Once one of is_due(), worth_classifying(), worth_sweeping() and
// worth_using() has returned false, the step uses no views.
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

// How a verified start finds out which triangles are clean: by views (L5) and then by layers (L9),
// or only by views.
enum class StartBy : std::uint8_t { view_and_layers, view_alone };

class CullingPolicy {
 public:
  virtual ~CullingPolicy() = default;

  // Returns whether a step of this culling can use views. If so, every step keeps track of clean
  // triangles, because a later step with views needs to know them.
  virtual bool may_use_views() const = 0;
  // Begins a step. Gets the motion of the mesh, the state from which the step goes on (or null),
  // and whether the step would need the views that the detector makes (FirstViews).
  virtual void begin(const SteppedMesh&, const StepState*, bool) {}
  // Decides whether this step shall place view primitives.
  virtual bool is_due() const = 0;
  // Returns the most work that making views may take, in box tests. After the attempt,
  // pay_for_views() gets whether the views were made, and the work done. If they were not made, the
  // step uses no views.
  virtual double most_for_views() const { return std::numeric_limits<double>::infinity(); }
  virtual void pay_for_views(bool /*are_made*/, double /*work*/) {}
  // Returns the anchors from which components are seen. `first` are the anchors of preprocessing.
  virtual const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first,
                                                 const PositionsView& vertices_t0,
                                                 PacedStop& pace) = 0;
  // Decides whether the step shall classify triangles. REQUIRES that primitives have been placed.
  virtual bool worth_classifying(const GivenStep& step, const StepMarks& marks) = 0;
  // Decides whether the step shall sweep ghosts. REQUIRES that triangles have been classified.
  virtual bool worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) = 0;
  // Decides how the step shall find out which triangles are clean at the start.
  virtual StartBy start_by() const = 0;
  // Decides whether the search shall use views. REQUIRES that the clean triangles are known.
  // `counts` are the counts of the step so far.
  virtual bool worth_using(const GivenStep& step, const StepMarks& marks,
                           const StepCounts& counts) = 0;

  // Decides whether the search shall prove patches apart. REQUIRES that types have been marked.
  virtual bool worth_proving(const StepMarks& marks, CandidateSearch& candidates) = 0;
  // Records the cost of a search with views. It is called after such a search, unless a first
  // contact has cut the search short. `candidates_of_k` is the number of candidates before the
  // closure.
  virtual void record_cost(const StepCounts& counts, std::uint64_t candidates_of_k) = 0;

  // Returns whether the step uses views, and if not, why, by the decisions made so far.
  virtual ViewUse use() const = 0;
  // Returns the state with which the policy of the next step begins. `contacts` is the number of
  // pairs in contact. After a search that a first contact has cut short, `contacts` and the counts
  // of the search are 0, because these would depend on the tree. has_own_primitives is true if the
  // primitives were placed at the anchors of this policy, and false if the caller gave them.
  virtual PolicyState next(const StepCounts& counts, std::size_t contacts,
                           bool has_own_primitives) const = 0;
};

// The policy of all other cullings: views always (Culling::view_point, Culling::view_line) or
// never.
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

// Returns the number of pairs of triangles that share a vertex. With Culling::bvh these pairs are
// candidates in every step, because their boxes touch. O(M).
std::uint64_t adjacent_pairs(const Topology& mesh);

// The policy of Culling::automatic and Culling::view_auto: a cost model of views and proofs.
//
// It weighs the expected saving of views against their expected cost. Saving and cost are computed
// from numbers of triangles and pairs in this step and in the committed steps before it, never from
// a clock: the same input gives the same bytes. View primitives can be anywhere (L3), so each step
// can have other primitives.
//
// The unit of cost is the cost of one candidate pair of Culling::bvh, including its box tests, axis
// order, elementary tests and its share of the refit: 0.15 to 0.2 us.
//
// From step to step the model is in one of two states. In the first step views are due.
//
//   state          event               next state
//   views are due  views pay           views are due; next_pause is halved, to 1 at least
//   views are due  views do not pay    next_pause steps of pause; next_pause doubles, at most to 32
//   pause          its last step ends  views are due
//
// When views are due, old anchors are first replaced. Anchors are old if they have been used for
// least_anchor_age steps, and if either views did not pay or the share of pairs that they save has
// fallen by an eighth from its best value.
//
// If most triangles were in contact in the last step, this step does not try to release them,
// because they will probably be in contact again. Views do not pay in such a step.
//
// In addition, Culling::automatic keeps an account of counted work in box tests (work_of_candidate
// and the constants beside it; the benches account/ compare it with times). Each step without views
// adds a share of its work to the credit. A step with views adds the work that Culling::bvh would
// have needed beyond the work of this step, estimated low, and pays for the work of views. Views
// are made and tried only if the credit can pay for them. So after any number of steps,
// Culling::automatic has done little more work than Culling::bvh would have done. If the mesh is
// positive as seen from its middle (a quick estimate), the step may also spend what views would
// save within this step. If only the first contact of the last step is known, the start would have
// to be verified anew, which costs more than views save, so such a step uses no views. Work that
// depends on the tree is not counted, so that a restored detector, which has a different tree,
// decides in the same way. A mesh at rest adds nothing to the credit.
//
// Example: on a sheet seen edge-on, views do not pay in steps 1, 3, 6, 11 and 20; between these
// there are pauses of 1, 2, 4 and 8 steps.
class CostModel : public CullingPolicy {
 public:
  // The share of its work that a step without views adds to the credit. detector/README.md allows
  // automatic twice this loss of time.
  static constexpr double earned_share = 0.05;

  // `adjacent` is adjacent_pairs() of the mesh. With saves_up (only Culling::automatic) it keeps an
  // account of work. The surface must outlive this object.
  CostModel(const Surface& surface, std::uint64_t adjacent, PolicyState before,
            bool saves_up = false)
      : surface_(surface), adjacent_(adjacent), state_(std::move(before)), saves_up_(saves_up) {}

  bool may_use_views() const override { return true; }
  void begin(const SteppedMesh& motion, const StepState* last_state, bool needs_views) override;
  // Returns whether views are due: there is no pause, and they cost no more than the account
  // allows.
  bool is_due() const override { return state_.pause == 0 && !waits_; }
  double most_for_views() const override;
  void pay_for_views(bool are_made, double work) override;
  // Chooses new anchors if that is due, from the positions at the start of the step.
  const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first,
                                         const PositionsView& vertices_t0,
                                         PacedStop& pace) override;

  // Classifies a few triangles of each large component, only in doubles. Returns false if doubles
  // can tell few of their signs, for example on a sheet seen edge-on. Integers would then have to
  // decide the other signs, and the view test would cost more than the rest of the step.
  bool worth_classifying(const GivenStep& step, const StepMarks& marks) override;
  // Returns whether the signs would save enough if all triangles were clean, and whether few enough
  // triangles are near ghosts. Refits the tree if the mesh is not closed.
  bool worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) override;
  // Returns view_alone, because layers cost about as much as a step of Culling::bvh.
  StartBy start_by() const override { return StartBy::view_alone; }
  // Returns whether the signs of the clean triangles save enough. If not, a pause begins, unless
  // nothing was known at the start.
  bool worth_using(const GivenStep& step, const StepMarks& marks,
                   const StepCounts& counts) override;

  bool worth_proving(const StepMarks& marks, CandidateSearch& candidates) override;
  // Returns whether normal cones and contours are expected to save more than they cost (L14).
  // asked_share is the share of the pairs of neighbours that are in K and that fans do not prove
  // apart.
  bool worth_proving(const ProvableShares& provable, double asked_share, std::size_t triangles);

  // Notes whether views have paid, which means that release, ghost sweep and closure cost less than
  // the pairs that views left out would have cost.
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
  // Estimates what views would save within this step if each component is seen from its middle.
  double hoped_at_a_glance(const SteppedMesh& motion) const;
  // Returns whether the work of Culling::bvh can be computed from the counts of the search. This is
  // not possible if proofs, or the sheets of a mesh at rest, leave out pairs, because which pairs
  // they leave out depends on the tree, and so on the positions that the detector was made from.
  bool counts_tell() const { return !proves_ && !is_at_rest_; }
  // Returns the credit after this step.
  double credit_after(const StepCounts& counts, std::size_t contacts) const;

  const Surface& surface_;
  std::uint64_t adjacent_;
  PolicyState state_;
  bool chose_anchors_ = false;
  double share_of_signs_ = 1;  // the share of pairs that the signs save if all triangles are clean
  double share_ = 1;           // the share that signs of clean triangles save; 1 in a free step
  bool paid_ = true;
  bool proves_ = false;
  ViewUse use_ = ViewUse::used;
  std::optional<double> overhead_;  // set if views were used in this step, or found not worth using

  bool saves_up_ = false, waits_ = false, is_at_rest_ = false;
  double most_for_views_ = 0;
  double spent_ = 0;                   // work of this step on views and the view test, in box tests
  std::optional<std::uint64_t> of_k_;  // candidates before the closure, once known
};

}  // namespace assay::detector
