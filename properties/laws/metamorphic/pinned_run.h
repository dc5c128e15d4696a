// Pins a run of a case: everything that the detector would choose for itself is prescribed.
//
// View primitives and apexes are means in doubles, summed in the order of the vertices. In a mesh
// that is renumbered, mirrored or moved they would differ in the last bits. So a changed run takes
// them from the original run, changed like the vertices, and every bit can be compared.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

// Returns the run that gave the results of `facts`, pinned, as a case. Returns nothing if a step
// has no views, if view-auto left a triangle dirty at a new start that another culling would
// release by layers, or if no detector can be made.
//
// Each step has two frames of its own, after the first frame of the case, which shapes the tree.
// The pinned points are stored as the case's ghosts, so that they change with the mesh: a fan for
// each hole, and for each component one triangle of a vertex and the two ends of its view
// primitive.
std::optional<Case> pinned_run(const CaseFacts& facts);

// Returns the options of the case, for a run of another mesh. view-auto decides by cost, for the
// mesh as a whole, whether it uses views. In a pinned run every step had views, and so must the
// other run; therefore its culling becomes view-line, which can also see from pinned points.
Options options_with_views(const CaseFacts& facts);

class PinnedPlayer {
 public:
  // Returns nothing if the holes of the mesh are not among those of the run (a boundary through
  // repeated vertices may be split in several ways). A mesh that the detector refuses has a player
  // too: each of its steps is that error. The run must outlive the player.
  static std::optional<PinnedPlayer> make(const Case& run, const Options& options,
                                          const StagesOf& stages_of);

  StepResult evaluate(std::size_t step);
  // Evaluates a step between any two positions, with the primitives and apexes of `step`.
  StepResult evaluate(std::size_t step, const PositionsView& x_t0, const PositionsView& x_t1);
  // Commits the step if the script commits it and the step was answered.
  void commit(std::size_t step, const StepResult& result);
  std::vector<StepResult> play();
  // REQUIRES a mesh that was not refused.
  detector::Detector& detector() { return *detector_; }

 private:
  class PinnedBoundary;
  PinnedPlayer(const Case& run, std::shared_ptr<PinnedBoundary> boundary);

  const Case* run_;
  std::optional<detector::Detector> detector_;  // or the problem of the mesh
  std::optional<detector::Problem> problem_;
  std::shared_ptr<PinnedBoundary> boundary_;
  // Places among the pinned points: of each loop's apex, of the first end of each component's view.
  Numbers apex_of_loop_, view_of_component_;
};

}  // namespace assay::properties
