// Which rule places the apex of each loop: the one whose ghosts touch fewest triangles at rest.
//
// A bad apex costs dirty triangles, never a wrong answer (L11 asks for ghosts that close the loops,
// wherever they stand), so the choice is given no more work than a step of culling bvh takes: it
// counts what it does, no clock. Loops are looked at from the shortest to the longest, each with
// its share, by its length, of what is left; of the share each rule gets a part alike. A rule that
// does not come to its end within that part is passed over. Where none does, the loop keeps the
// first rule, its centroid.
//
// A fan of valence n over n triangles is such a loop: the boxes of its ghosts and triangles all
// hold a place near its hub, so n^2 pairs come up. Its own step under bvh is quadratic for the same
// reason (34 s at n = 20,000): what candidates are found by are boxes of triangles. Boxes of edges
// and vertices would leave n vertices against n faces apart, for an edge at the rim is as short as
// its triangle is narrow; the edges of the hub would still meet in one place.
#pragma once

#include <optional>

#include "detector/boundary/apex.h"
#include "detector/boundary/ghost_sweep.h"

namespace assay::detector {

class ApexChoice {
 public:
  struct Result {
    std::vector<ApexRule> rules;  // by loop
    GhostCounts counts;
    std::size_t cut_short = 0;  // sweeps that were ended for the work that they took
  };

  // In units of work (GhostCounts): a step of bvh takes 0.8 to 1.4 us a triangle, 160 to 280 box
  // tests. The base is 1 ms.
  static constexpr std::uint64_t work_per_triangle = 200, base_work = 200'000;

  // tree: of the mesh, refitted to x. Ghosts and triangles count. The references must outlive this
  // object.
  ApexChoice(const Surface& surface, const BoundingVolumeTree& tree, const PositionsView& x,
             const ElementaryTest& elementary, const StopFunction& stop);

  // O(1) a triangle and ghost. Of no use where `stop` asked for an end.
  Result run();

 private:
  ApexRule choose(std::size_t loop, std::uint64_t share);
  // How many triangles the ghosts touch; nothing when that is not less than `fewest`, or takes more
  // than `most_work`.
  std::optional<std::size_t> touched_by(std::size_t loop, const ApexRule& rule, std::size_t fewest,
                                        std::uint64_t most_work);
  std::uint64_t work() const { return result_.counts.work() + placing_; }

  const Surface& surface_;
  Positions all_;  // of the mesh, and below it the apexes that are tried
  PositionsView x_, view_of_all_;
  PacedStop stop_;
  GhostSweep sweep_;
  std::vector<std::int32_t> ghosts_, found_;
  std::vector<std::size_t> first_ghost_;  // by loop
  std::vector<std::uint8_t> touched_;     // none, between two sweeps
  std::uint64_t placing_ = 0;             // work beside the sweeps
  Result result_;
};

}  // namespace assay::detector
