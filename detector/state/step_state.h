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

// The anchors of all components, shared by copies of a state. Equal if they hold equal anchors.
struct SharedAnchors {
  std::shared_ptr<const std::vector<ViewAnchor>> list;  // may be null

  friend bool operator==(const SharedAnchors& a, const SharedAnchors& b) {
    return a.list && b.list ? *a.list == *b.list : a.list == b.list;
  }
};

// The state of the cost model (step/culling_policy.h) between steps: where components are seen
// from, and whether using views has paid.
struct PolicyState {
  // One anchor for each component. Null: those of the detector's preprocessing.
  SharedAnchors anchors;
  bool anchors_are_due = false;         // the anchors are chosen again when views are next due
  std::uint64_t anchor_age = 0;         // steps since the anchors were chosen
  std::uint64_t least_anchor_age = 16;  // they are kept for at least this many steps
  double best_share = 0;   // the greatest share of pairs that the signs from these anchors saved
  double replaced_at = 0;  // the share of the previous anchors when they were replaced

  std::uint64_t pause = 0;       // this many of the next steps do without views
  std::uint64_t next_pause = 1;  // the pause if views do not pay when they are next due
  std::uint64_t candidates = 0;  // of the last search that proved nothing apart; 0: there was none
  // The cost of closure, ghost sweep and release, in candidates, when views were last used in a
  // search. It was halved by each later step in which views were due.
  double overhead = 0;

  // The account of Culling::automatic, in box tests of 5 ns: how much more work than `bvh` it may
  // still take. It starts with 0.04 ms.
  double credit = 8'000;
  double tried = 0;        // this much work was too little to make views
  bool has_views = false;  // views are made and paid for

  friend bool operator==(const PolicyState&, const PolicyState&) = default;
};

struct StepState {
  // The positions at the end of the step. The other members hold at these positions alone, compared
  // bit by bit.
  Positions positions;
  // By triangle: 1 if it is clean by L8, that is, clean when the step began, in no contact with
  // its own component and touched by no ghost during it. The others may be released by the next
  // step (L9). After a step without views no triangle of a component with ghosts is clean, because
  // nobody swept the ghosts (L15).
  std::vector<std::uint8_t> clean;
  // Pairs in contact during the step, both triangles of the same component. They may be only some
  // of these pairs after a collision that was found by K alone: contacts_are_complete is then
  // false.
  std::vector<TrianglePair> contacts;
  bool contacts_are_complete = true;
  // By component: its view primitive at these positions, if the winding number there is known to
  // be 1. The number stays 1 while all triangles stay positive, so L5 need not count it again.
  std::vector<std::optional<std::array<Point, 2>>> inside;

  // Evaluations leave `policy` as it was when the last step was committed.
  PolicyState policy;

  // `keep` stores `x` as the positions; `holds_at` says whether `x` equals them in every bit. The
  // workers of the pace share the work; it is not asked to stop.
  void keep(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops));
  bool holds_at(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops)) const;
  // Positions are compared bit by bit.
  friend bool operator==(const StepState& a, const StepState& b);
};

// The contents of a SavedState (detector.h).
struct StateFields {
  std::uint64_t mesh = 0;  // digest of the triangles and the number of vertices
  Culling culling = Culling::view_point;
  std::optional<StepState> committed;  // nothing: the next step is a new start
  // Rules and anchors are chosen from the positions that the detector was made from. They belong
  // to the state because an apex must not jump between steps (cases D7, D9).
  std::vector<ApexRule> apex_rules;
  std::vector<ViewAnchor> anchors;
  double view_work = 0;  // the work of choosing these, in box tests

  friend bool operator==(const StateFields&, const StateFields&) = default;
};

// Returns the digest of a mesh: equal for equal triangles in the same order and equal vertex
// counts. O(M).
std::uint64_t digest_of(const Topology& mesh, std::int32_t vertex_count);

// Returns whether all sizes and indices of the state fit a detector of this surface that has
// `anchors` anchors of its own. REQUIRES as many apex rules as that detector has. It does not check
// that the triangles that the state calls clean are clean. O(M).
bool fits(const StateFields& state, const Surface& surface, std::size_t anchors);

}  // namespace assay::detector
