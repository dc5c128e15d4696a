// The traditional scheme [VMT94]: normal cones and contour tests on the BVH, made sound over a
// step.
//
// A search that leaves out what L13 (moving_contour.h) proves free: the pairs below a node whose
// triangles have a normal cone and a contour that stays simple, and those of two nodes that share
// edges and have both together. All else is told apart by boxes, as in TreeSearch, so its
// candidates are some of those. It asks for no views and knows no state: every step stands alone,
// and every pair in contact is found. A feature pair is tested at one pair of triangles that hold
// it (feature_pairs.h); where that pair is left out, the features lie in one patch and do not meet.
#pragma once

#include "detector/search/pair_search.h"
#include "detector/traditional/moving_contour.h"

namespace assay::detector {

class NormalConeSearch : public PairSearch {
 public:
  // The contours of all nodes: they are of the mesh alone.
  std::unique_ptr<KeptBySearch> prepare(const Topology& mesh, const BoundingVolumeTree& tree,
                                        PacedStop& pace) const override;
  // 0.1 us a triangle for the cones, besides the descent.
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;

  // The tests that the scheme rests on, each replaceable.
  virtual DirectionSet faced(const std::array<MovingPoint, 3>& triangle) const {
    return faced_directions(triangle);
  }
  virtual bool stays_simple(MovingContour& moving, Contour contour, int direction_bit) const {
    return moving.stays_simple(contour, direction_bit);
  }
  virtual std::unique_ptr<ContourMaker> contour_maker(const Topology& mesh) const {
    return std::make_unique<ContourMaker>(mesh);
  }
};

}  // namespace assay::detector
