// What only steps with views need: where each component is seen from, and the rules that place
// apexes. They are made when views are first due and not when the detector is created, because
// they take longer than everything else there.
//
// They rest on the positions that the detector was created with, which are kept until then. So it
// does not show when they were made: an evaluation leaves the state as it was.
#pragma once

#include <optional>
#include <vector>

#include "detector/step/stages.h"
#include "detector/view/view_anchor.h"

namespace assay::detector {

class FirstViews {
 public:
  // Of a culling without views: there is nothing to make.
  FirstViews() = default;
  explicit FirstViews(const PositionsView& x) : x_(x) {}

  // Makes them, unless that was done before. It leaves the boxes of the tree fitted to other
  // positions. False if it was stopped; then nothing is kept.
  bool make(const Surface& surface, BoundingVolumeTree& tree, const Stages& stages, Culling culling,
            PacedStop& pace);
  // Others in their place, from a saved state.
  void replace(std::vector<ViewAnchor> anchors, std::vector<ApexRule> rules);

  // By component and by loop. Empty before they are made, and with a culling without views.
  const std::vector<ViewAnchor>& anchors() const { return anchors_; }
  const std::vector<ApexRule>& apex_rules() const { return apex_rules_; }

 private:
  std::optional<Positions> x_;  // nothing once they are made
  std::vector<ViewAnchor> anchors_;
  std::vector<ApexRule> apex_rules_;
};

}  // namespace assay::detector
