// What the cost model (step/cost_model.h) keeps from step to step: where components are seen from,
// and whether using views has paid.
#pragma once

#include <memory>
#include <vector>

#include "detector/view/view_anchor.h"

namespace assay::detector {

struct PolicyState {
  // One anchor for each component. Null: those of the detector's preprocessing.
  std::shared_ptr<const std::vector<ViewAnchor>> anchors;
  bool anchors_are_due = false;         // the anchors are chosen again when views are next due
  std::uint64_t anchor_age = 0;         // steps since the anchors were chosen
  std::uint64_t least_anchor_age = 16;  // they are kept for at least so many steps
  double best_share = 0;   // the greatest share of pairs that the signs from these anchors saved
  double replaced_at = 0;  // the share to which the anchors before them had come down

  std::uint64_t pause = 0;       // so many steps to come do without views
  std::uint64_t next_pause = 1;  // the pause if views do not pay when they are next due
  std::uint64_t candidates = 0;  // of the last search that proved nothing apart; 0: there was none
  // What closure, ghost sweep and release cost, in candidates, when views were last used in a
  // search. It is halved by each step since in which views were due.
  double overhead = 0;
};

}  // namespace assay::detector
