// The stage of the detector that handles holes: it makes ghosts, places their apexes, and finds the
// triangles that ghosts touch.
#pragma once

#include <array>
#include <optional>

#include "detector/boundary/ghost_sweep.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

// A rule that places the apex of a ghost fan. It reads the positions of one frame only.
//
// During a step the apex moves linearly between its places at t=0 and at t=1, so its path is
// continuous from step to step too. With an apex that stays behind or jumps, contacts are missed
// (cases D7, D9).

// Puts the apex at the loop's centroid, moved along the loop's mean normal by `height` times the
// diagonal of the loop's box. The centroid itself (height 0) would spoil the culling of open
// sheets, because the ghosts would cut the sheet.
struct ApexRule {
  double height = 0;

  friend bool operator==(const ApexRule&, const ApexRule&) = default;
};

// The rules to choose from. If several are equally good, the first of them is taken.
inline constexpr std::array<ApexRule, 5> apex_rules = {{{0.0}, {0.25}, {-0.25}, {1.0}, {-1.0}}};

// Returns the place of the apex in one frame. The place is computed in doubles, summed in the order
// of the loop, so it has the same bytes on every machine. It is the centroid if the mean normal
// vanishes or overflows, and it is finite for finite positions.
Point place_apex(const ApexRule& rule, const Loop& loop, const PositionsView& x);

// Returns the rows of x and, below them, the places of the apexes: at t=1 if at_end, else at t=0.
Positions with_apexes(const PositionsView& x, const std::vector<MovingPoint>& apexes, bool at_end);

// Chooses for each loop the rule that places its apex: the rule with which the ghosts touch the
// fewest triangles of the mesh at rest.
//
// A bad apex costs dirty triangles but never makes an answer wrong, because L11 only needs ghosts
// that close the loops, wherever the apexes are. So ApexChoice must not take more work than a step
// of Culling::bvh. It counts its work, and does not measure time. Loops are handled from the
// shortest to the longest. Each loop gets a share of the remaining work, in proportion to its
// length. A share is at least 4,000 box tests, so a mesh of many tiny holes can take several times
// the work of such a step. The rules of a loop divide its share evenly. A rule that does not finish
// within its part is passed over. If no rule finishes, the loop gets the first rule, the centroid.
//
// An example where no rule finishes is the loop around a fan of n triangles at one hub. The boxes
// of all its ghosts and triangles contain a place near the hub, so there are n^2 pairs of boxes
// that meet. A step of this mesh with Culling::bvh is quadratic for the same reason (34 s at n =
// 20,000), because candidates are found by boxes of triangles. With boxes of edges and vertices the
// n vertices would be apart from the n faces, because an edge at the rim is as short as its
// triangle is narrow. But the edges at the hub would still meet in one place.
class ApexChoice {
 public:
  struct Result {
    std::vector<ApexRule> rules;  // by loop
    GhostCounts counts;
    std::size_t cut_short = 0;  // sweeps that were ended because they took too much work
  };

  // The most work that choosing the rules takes, in the units of GhostCounts::work (box tests):
  // work_per_triangle for each triangle and ghost, and base_work (1 ms) once. A step of
  // Culling::bvh takes 0.8 to 1.4 us a triangle, as much as 160 to 280 box tests.
  static constexpr std::uint64_t work_per_triangle = 200, base_work = 200'000;

  // The stop function is called after each such amount of work on choosing the rules.
  static constexpr std::uint64_t work_between_asks = 10'000;

  // REQUIRES the tree of the mesh, refitted to x. The references must outlive this object.
  ApexChoice(const Surface& surface, const BoundingVolumeTree& tree, const PositionsView& x,
             const ElementaryTest& elementary, const StopFunction& stop);

  // Chooses the rules. O(1) for each triangle and ghost. If the stop function returned true, the
  // result must not be used.
  Result run();

 private:
  ApexRule choose(std::size_t loop, std::uint64_t share);
  // Returns how many triangles the ghosts of the loop touch with this rule; nullopt if the number
  // is not below `fewest`, or if counting takes more than `most_work`.
  std::optional<std::size_t> touched_by(std::size_t loop, const ApexRule& rule, std::size_t fewest,
                                        std::uint64_t most_work);
  std::uint64_t work() const { return result_.counts.work() + placing_; }

  const Surface& surface_;
  Positions all_;  // rows: vertices of the mesh, then the apexes that are tried
  PositionsView x_, view_of_all_;
  PacedStop stop_;
  GhostSweep sweep_;
  std::vector<std::int32_t> ghosts_, found_;
  std::vector<std::size_t> first_ghost_;  // by loop
  std::vector<std::uint8_t> touched_;     // all 0 between two sweeps
  std::uint64_t placing_ = 0;             // work outside of the sweeps
  Result result_;
};

class BoundaryHandler {
 public:
  virtual ~BoundaryHandler() = default;

  // Returns the mesh with its ghosts. If `pace` was stopped, the result must not be used.
  virtual Surface close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                           PacedStop& pace) const;

  // Chooses, for each loop, the rule that places its apex in all steps of a detector: a rule with
  // which the ghosts touch few triangles at the positions x (ApexChoice). If `stop` returned true,
  // the result must not be used.
  virtual std::vector<ApexRule> choose_apexes(const Surface& surface, BoundingVolumeTree& tree,
                                              const PositionsView& x,
                                              const ElementaryTest& elementary,
                                              const StopFunction& stop = {}) const;

  // Returns the path of each loop's apex over a step. The place of an apex at a time depends only
  // on the positions at that time, so an apex begins each step where it ended the last step.
  virtual std::vector<MovingPoint> place_apexes(const Surface& surface,
                                                const std::vector<ApexRule>& rules,
                                                const SteppedMesh& motion) const;

  // Sets touched[t] for each triangle t that the given ghosts touch (L11). It goes hole by hole,
  // with a small tree for each hole. REQUIRES ghosts of one component. Returns false if `stop`
  // returned true.
  virtual bool sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
                     const StopFunction& stop, std::vector<std::uint8_t>& touched,
                     GhostCounts& counts) const;
};

}  // namespace assay::detector
