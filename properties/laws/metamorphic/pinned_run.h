// Pins a run of a case: everything that the detector would choose for itself is prescribed.
//
// View primitives and apexes are means in doubles, summed in the order of the vertices. In a mesh
// that is renumbered, mirrored or moved they would differ in the last bits. So a changed run takes
// primitives and apexes from the original run and changes them like the vertices. Then every bit
// can be compared.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

// Pins the run that gave the results of `facts`, and returns it as a case. Returns nothing if a
// step has no views, if no detector can be made, or if Culling::view_auto left a triangle dirty at
// a new start although another culling would release it by layers.
//
// Each step has two frames of its own, after the first frame of the case, which shapes the tree.
// The pinned points are stored as the case's ghosts, so that they change with the mesh: a fan for
// each hole, and for each component one triangle of a vertex and the two ends of its view
// primitive.
std::optional<Case> pinned_run(const CaseFacts& facts);

// Returns the options for a run of a changed mesh: those of the case, but with Culling::view_line
// if the culling of the case chooses views itself. Such a culling decides by the cost of the whole
// mesh whether a step uses views. In a pinned run every step has views, so every step of the other
// run needs views, too. view_line can also see from pinned points.
Options options_with_views(const CaseFacts& facts);

class PinnedPlayer {
 public:
  // Returns nothing if the holes of the mesh are not among the holes of the run (a boundary through
  // repeated vertices can be split in several ways). If the detector refuses the mesh, there is a
  // player, too: each of its steps returns this refusal. The run must outlive the player.
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
  std::optional<detector::Detector> detector_;  // absent if the mesh was refused
  std::optional<detector::Problem> problem_;    // then: why it was refused
  std::shared_ptr<PinnedBoundary> boundary_;
  // Indices of pinned points: by loop, its apex; by component, the first end of its view primitive.
  Numbers apex_of_loop_, view_of_component_;
};

}  // namespace assay::properties
