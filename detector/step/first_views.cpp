#include "detector/step/first_views.h"

namespace assay::detector {
namespace {

// One anchor for each component: where it is seen from best, with its ghosts, at these positions.
// Where views are used only if they pay, their search has to be cheap beside a step.
std::vector<ViewAnchor> place_anchors(const Surface& surface,
                                      const std::vector<ApexRule>& apex_rules, Culling culling,
                                      const PositionsView& positions, PacedStop& pace) {
  std::vector<MovingPoint> apexes;
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    const Point apex = place_apex(apex_rules[l], surface.loops[l], positions);
    apexes.push_back({apex, apex});
  }
  const Positions x = with_apexes(positions, apexes, false);
  std::vector<ViewAnchor> anchors;
  for (const auto& component : surface.all().components) {
    const Effort effort = effort_for(component, surface.mesh,
                                     chooses_views(culling) ? Effort::brief : Effort::thorough);
    if (pace.after(effort == Effort::least ? 400 : 20'000)) break;
    if (chooses_views(culling)) {
      anchors.push_back(
          choose_view_anchor(surface.all(), component, surface.first_apex, x, effort, &pace));
    } else {
      const ViewKind kind = culling == Culling::view_line ? ViewKind::line : ViewKind::point;
      anchors.push_back(
          make_view_anchor(kind, surface.all(), component, surface.first_apex, x, effort, &pace));
    }
  }
  return anchors;
}

}  // namespace

bool FirstViews::make(const Surface& surface, BoundingVolumeTree& tree, const Stages& stages,
                      Culling culling, PacedStop& pace) {
  if (!x_) return true;
  // Once the stop function has asked for an end it is not asked again.
  const StopFunction paced = [&] { return pace.now(); };
  std::vector<ApexRule> rules;
  if (!surface.is_closed())
    rules = stages.boundary->choose_apexes(surface, tree, *x_, *stages.elementary, paced);
  tree.forget_fit();
  if (pace.stopped()) return false;
  auto anchors = place_anchors(surface, rules, culling, *x_, pace);
  if (pace.stopped()) return false;
  replace(std::move(anchors), std::move(rules));
  return true;
}

void FirstViews::replace(std::vector<ViewAnchor> anchors, std::vector<ApexRule> rules) {
  anchors_ = std::move(anchors);
  apex_rules_ = std::move(rules);
  x_.reset();
}

}  // namespace assay::detector
