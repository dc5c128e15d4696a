// What culling automatic and view_auto keep from step to step: where they look from, and whether
// looking has paid.
#pragma once

#include <memory>
#include <vector>

#include "detector/view/view_anchor.h"

namespace assay::detector {

struct ViewChoice {
  // One for each component; null: those of the detector's preprocessing.
  std::shared_ptr<const std::vector<ViewAnchor>> anchors;
  bool is_worn = false;          // to be chosen again at the next look
  std::uint64_t age = 0;         // steps since they were chosen
  std::uint64_t least_age = 16;  // before they are chosen again
  double best_share = 0;         // greatest share of pairs that their signs saved
  double share_before = 0;       // the share that the ones before them had come down to

  std::uint64_t rest = 0;        // steps to come without views
  std::uint64_t next_rest = 1;   // should the next look not pay
  std::uint64_t candidates = 0;  // of the last search that proved nothing apart; 0: none has
  // What views took beside the pairs of K (closure, sweep, release) when they were last used in a
  // search, in candidates; halved by each look since.
  double overhead = 0;
};

}  // namespace assay::detector
