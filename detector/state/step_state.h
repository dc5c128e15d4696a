// The state that the detector has of its mesh between steps (L8).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "detector/boundary/boundary_handler.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/surface.h"
#include "detector/mesh/topology.h"
#include "detector/options.h"
#include "detector/view/view_anchor.h"

namespace assay::detector {

// The view anchors of all components, shared by copies of a state. Two SharedAnchors are equal if
// their anchors are equal.
struct SharedAnchors {
  std::shared_ptr<const std::vector<ViewAnchor>> list;  // may be null

  friend bool operator==(const SharedAnchors& a, const SharedAnchors& b) {
    return a.list && b.list ? *a.list == *b.list : a.list == b.list;
  }
};

// The state of the cost model (step/culling_policy.h) between steps: from where components are
// seen, and whether views have paid.
struct PolicyState {
  // One anchor for each component. If null, the anchors of the detector's preprocessing are used.
  SharedAnchors anchors;
  bool anchors_are_due = false;         // the anchors are chosen again when views are next due
  std::uint64_t anchor_age = 0;         // steps since the anchors were chosen
  std::uint64_t least_anchor_age = 16;  // the anchors stay for at least this many steps
  double best_share = 0;   // the greatest share of pairs that the signs from these anchors saved
  double replaced_at = 0;  // the share that the previous anchors saved when they were replaced

  std::uint64_t pause = 0;       // the number of coming steps that use no views
  std::uint64_t next_pause = 1;  // the next value of `pause`, if views do not pay when next due
  // The number of candidates in the last search of a moving mesh that used no proofs; 0 if there
  // was none.
  std::uint64_t candidates = 0;
  // The cost of closure, ghost sweep and release, in candidates, of the last search that used
  // views. Each later step in which views are due halves it.
  double overhead = 0;

  // The account of Culling::automatic, in box tests of 5 ns: the work that it may take beyond the
  // work of `bvh`. At first this is 0.04 ms.
  double credit = 8'000;
  double tried = 0;        // this much work was too little in the last attempt to make views
  bool has_views = false;  // the views are made, and the credit has paid for making them

  friend bool operator==(const PolicyState&, const PolicyState&) = default;
};

struct StepState {
  // The positions at the end of the step. The other members are valid only at exactly these
  // positions, compared bit by bit.
  Positions positions;
  // By triangle: 1 if the triangle is clean by L8: it was clean when the step began, and during the
  // step it was in no contact with its own component and no ghost touched it. The next step may
  // release the other triangles (L9). After a step without views no triangle of a component with
  // ghosts is clean, because no ghost was swept (L15).
  std::vector<std::uint8_t> clean;
  // Pairs in contact during the step, both triangles of the same component. After a collision that
  // was found without the closure (L7), some pairs may be missing: then contacts_are_complete is
  // false.
  std::vector<TrianglePair> contacts;
  bool contacts_are_complete = true;
  // By component: the view primitive at these positions, if the winding number at this primitive is
  // known to be 1. The number stays 1 while all triangles stay positive, so it need not be counted
  // again for L5.
  std::vector<std::optional<std::array<Point, 2>>> inside;

  // Only a committed step changes `policy`; evaluations do not.
  PolicyState policy;

  // `keep` stores `x` as the positions; `holds_at` returns whether `x` equals the positions in
  // every bit. The workers of the pace share the work; its stop function is not called.
  void keep(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops));
  bool holds_at(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops)) const;
  // Positions are compared bit by bit.
  friend bool operator==(const StepState& a, const StepState& b);
};

// The contents of a SavedState (detector.h).
struct StateFields {
  std::uint64_t mesh = 0;  // digest of the triangles and the number of vertices
  Culling culling = Culling::view_point;
  std::optional<StepState> committed;  // nullopt: the next step is a new start
  // Rules and anchors are chosen from the positions that the detector was made from. They belong
  // to the state because an apex must not jump between steps (cases D7, D9).
  std::vector<ApexRule> apex_rules;
  std::vector<ViewAnchor> anchors;
  double view_work = 0;  // the work of choosing rules and anchors, in box tests

  friend bool operator==(const StateFields&, const StateFields&) = default;
};

// Returns the digest of a mesh: equal for equal triangles in the same order and equal vertex
// counts. O(M).
std::uint64_t digest_of(const Topology& mesh, std::int32_t vertex_count);

// Returns whether all sizes and indices in the state fit a detector of this surface that has this
// number of anchors. REQUIRES that the state and the detector have the same number of apex rules.
// Does not check that the triangles called clean in the state are clean. O(M).
bool fits(const StateFields& state, const Surface& surface, std::size_t anchors);

}  // namespace assay::detector
