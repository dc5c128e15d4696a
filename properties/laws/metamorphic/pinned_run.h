// A run of a case with everything that the detector would choose for itself nailed down.
//
// View primitives and apexes are means in doubles, summed in the order of vertices: of a mesh that
// is numbered otherwise, mirrored or moved they would differ in the last bits. A changed run takes
// them from the run that it is compared with, changed like the vertices, so that the comparison is
// one of every bit.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

struct PinnedRun {
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
  std::vector<corpus::CaseStep> script;
  std::vector<std::int32_t> seats;                               // one triangle of each component
  std::vector<std::vector<detector::ViewPrimitive>> primitives;  // [step][seat]
  std::vector<detector::Loop> loops;                       // in any direction, from any vertex
  std::vector<std::vector<detector::MovingPoint>> apexes;  // [step][loop]
};

// The run that gave the results; nothing where a step has no views, where view-auto left something
// dirty that it would have released by layers, or where no detector can be made.
std::optional<PinnedRun> pinned_run(const CaseFacts& facts);

// The options of the case, for a run of another mesh. Whether view-auto uses its views is a matter
// of cost and decided for the mesh as a whole; in a pinned run every step had them. So that the
// other run has them too its culling is view-line, which sees from the pinned points as well.
detector::Options options_with_views(const CaseFacts& facts);

class PinnedPlayer {
 public:
  // Nothing where the holes of the mesh are others than those of the run (a boundary through
  // repeated vertices may be split in several ways). A mesh that is refused has a player all the
  // same: every step of it is that error. The run must outlive the player.
  static std::optional<PinnedPlayer> make(const PinnedRun& run, const detector::Options& options,
                                          const StagesOf& stages_of);

  detector::StepResult evaluate(std::size_t step);
  // Between any two frames, with the primitives and apexes of `step`.
  detector::StepResult evaluate(std::size_t step, const detector::PositionsView& x_t0,
                                const detector::PositionsView& x_t1);
  // Where the script commits the step and it was answered.
  void commit(std::size_t step, const detector::StepResult& result);
  std::vector<detector::StepResult> play();
  // REQUIRES a mesh that was not refused.
  detector::Detector& detector() { return *detector_; }

 private:
  class PinnedBoundary;
  PinnedPlayer(const PinnedRun& run, std::shared_ptr<PinnedBoundary> boundary);

  const PinnedRun* run_;
  std::optional<detector::Detector> detector_;  // or the problem of the mesh
  std::optional<detector::Problem> problem_;
  std::shared_ptr<PinnedBoundary> boundary_;
  std::vector<std::size_t> seat_of_component_, loop_of_apex_;
};

}  // namespace assay::properties
