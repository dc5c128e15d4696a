// The stage of the detector that handles holes: it makes ghosts, places their apexes, and finds the
// triangles that ghosts touch.
#pragma once

#include <array>
#include <optional>

#include "detector/boundary/ghost_sweep.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

// Where the apex of a ghost fan stands: a deterministic function of one frame's positions.
//
// During a step the apex moves linearly between its places at the two frames, so it is also
// continuous from step to step. An apex that stays behind, or jumps, misses contacts (cases D7,
// D9).

// Puts the apex at the loop's centroid, moved along the loop's mean normal by `height` times the
// diagonal of the loop's box. The centroid itself (height 0) would ruin culling on sheets, because
// ghosts through it cut the sheet.
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

// Chooses for each loop the rule that places its apex: the one whose ghosts touch fewest triangles
// at rest.
//
// A bad apex costs dirty triangles but never makes an answer wrong, because L11 asks only for
// ghosts that close the loops, wherever they stand. So the choice may take no more work than a
// step of Culling::bvh. It counts its work and looks at no clock. Loops are handled from the
// shortest to the longest. Each loop gets a share of the work that is left, in proportion to its
// length, but no less than 4,000 box tests, so a mesh of many tiny holes may take several times as
// much. The rules of a loop divide its share evenly. A rule that does not finish within its part is
// passed over. If no rule finishes, the loop keeps the first one, its centroid.
//
// An example where no rule finishes is the loop around a fan of n triangles at one hub. The boxes
// of its ghosts and triangles all hold a place near the hub, so n^2 pairs come up. A step of this
// mesh under bvh is quadratic for the same reason (34 s at n = 20,000), because candidates are
// found by boxes of triangles. With boxes of edges and vertices the n vertices would be apart from
// the n faces, because an edge at the rim is as short as its triangle is narrow. But the edges at
// the hub would still meet in one place.
class ApexChoice {
 public:
  struct Result {
    std::vector<ApexRule> rules;  // by loop
    GhostCounts counts;
    std::size_t cut_short = 0;  // sweeps that were ended because they took too much work
  };

  // The work that the choice may take, in the units of GhostCounts::work (box tests):
  // work_per_triangle for each triangle and ghost, and base_work (1 ms) once. A step of bvh takes
  // 0.8 to 1.4 us a triangle, as much as 160 to 280 box tests.
  static constexpr std::uint64_t work_per_triangle = 200, base_work = 200'000;

  // The stop function is asked each time the choice has done this much work.
  static constexpr std::uint64_t work_between_asks = 10'000;

  // REQUIRES the tree of the mesh, refitted to x. The references must outlive this object.
  ApexChoice(const Surface& surface, const BoundingVolumeTree& tree, const PositionsView& x,
             const ElementaryTest& elementary, const StopFunction& stop);

  // Chooses the rules. O(1) for each triangle and ghost. If `stop` asked for an end, the result
  // must not be used.
  Result run();

 private:
  ApexRule choose(std::size_t loop, std::uint64_t share);
  // Returns how many triangles the ghosts of the loop touch under this rule; nothing if the number
  // is not below `fewest`, or if counting them takes more than `most_work`.
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
  std::uint64_t placing_ = 0;             // work beside the sweeps
  Result result_;
};

class BoundaryHandler {
 public:
  virtual ~BoundaryHandler() = default;

  // Returns the mesh with its ghosts. If `pace` was stopped, the result must not be used.
  virtual Surface close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                           PacedStop& pace) const;

  // Chooses for each loop the rule that places its apex for the life of a detector: one whose
  // ghosts touch few triangles at x (ApexChoice). If `stop` asked for an end, the result must not
  // be used.
  virtual std::vector<ApexRule> choose_apexes(const Surface& surface, BoundingVolumeTree& tree,
                                              const PositionsView& x,
                                              const ElementaryTest& elementary,
                                              const StopFunction& stop = {}) const;

  // Returns the path of each loop's apex over a step. The place of an apex at either end depends on
  // that frame alone, so each step finds the apex where the last step left it.
  virtual std::vector<MovingPoint> place_apexes(const Surface& surface,
                                                const std::vector<ApexRule>& rules,
                                                const SteppedMesh& motion) const;

  // Sets touched[t] for each triangle t that the given ghosts touch (L11). It goes hole by hole,
  // with a small tree for each hole. REQUIRES ghosts of one component. Returns false if `stop`
  // ended it.
  virtual bool sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
                     const StopFunction& stop, std::vector<std::uint8_t>& touched,
                     GhostCounts& counts) const;
};

}  // namespace assay::detector
