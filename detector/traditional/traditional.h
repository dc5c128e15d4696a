// The traditional scheme [VMT94]: normal cones and contour tests on the BVH, made sound over a
// step.
//
// A search that leaves out what L13 (moving_contour.h) proves free: the pairs below a node whose
// triangles have a normal cone and a contour that stays simple, and those of two nodes that share
// edges and have both together. All else is told apart by boxes and by the pair rule, as in
// TreeSearch, so its candidates are some of those. With culling normal_cone the rule asks for every
// pair: no views, no state, every step stands alone. With culling automatic it asks for K (L14).
// Either way what L3 and L7 promise is found, for no pair that is left out is in contact. A feature
// pair is tested at one pair of triangles that hold it (feature_pairs.h); where that pair is left
// out, the features lie in one patch and do not meet.
#pragma once

#include "detector/search/pair_search.h"
#include "detector/traditional/moving_contour.h"

namespace assay::detector {

class NormalConeSearch : public TreeSearch {
 public:
  // Patches of which proofs are asked. A proof costs about what four candidates cost and, of so few
  // triangles, leaves out fewer.
  enum class Asked : std::uint8_t { all, of_four_triangles_or_more };
  explicit NormalConeSearch(Asked asked = Asked::all) : asked_(asked) {}
  Asked asked() const { return asked_; }

  // The contours of all nodes: they are of the mesh alone.
  std::unique_ptr<KeptBySearch> prepare(const Topology& mesh, const BoundingVolumeTree& tree,
                                        PacedStop& pace) const override;
  // 0.1 us a triangle for the cones, besides the descent; a TreeSearch where proofs are not used.
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
  // Of 4 to 32 patches of 12 triangles, 3 us each, and of 1 to 8 of 96 triangles, 25 us each.
  ProvableShares provable_shares(const SearchInput& input) const override;

  // The tests that the scheme rests on, each replaceable.
  virtual DirectionSet faced(const std::array<MovingPoint, 3>& triangle) const {
    return faced_directions(triangle);
  }
  virtual bool stays_simple(MovingContour& moving, Contour contour, int direction_bit) const {
    return moving.stays_simple(contour, direction_bit);
  }
  virtual Contour joined(ContourUnion& both, Contour a, Contour b) const { return both.join(a, b); }
  virtual std::unique_ptr<ContourMaker> contour_maker(const Topology& mesh) const {
    return std::make_unique<ContourMaker>(mesh);
  }

 private:
  bool is_free(const SearchInput& input, MovingContour& moving,
               const std::vector<std::int32_t>& patch) const;
  Asked asked_;
};

}  // namespace assay::detector
