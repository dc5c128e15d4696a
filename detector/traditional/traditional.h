// The traditional scheme [VMT94]: normal cones and contour tests on the BVH, made sound over a
// step.
//
// It is a search that leaves out the pairs that L13 (moving_contour.h) proves free. These are: all
// pairs below a node, if its triangles have a normal cone and a contour that stays simple; and all
// pairs between two nodes that share edges, if the triangles of both nodes together have such a
// cone and such a contour. In all other respects it is a TreeSearch. So the candidates are a subset
// of the candidates of TreeSearch.
//
// With Culling::normal_cone the pair rule asks for every pair; there are no views and no state, and
// no step depends on earlier steps. With Culling::automatic the rule asks for K (L14). With both
// cullings the search finds what L3 and L7 promise, because no pair that it leaves out is in
// contact. A feature pair is tested at one of the pairs of triangles that contain it
// (feature_pairs.h). If that pair of triangles is left out, the features lie in one patch and do
// not meet.
#pragma once

#include "detector/search/pair_search.h"
#include "detector/traditional/moving_contour.h"

namespace assay::detector {

class NormalConeSearch : public TreeSearch {
 public:
  // The patches for which proofs are attempted. A proof costs as much as about four candidates, and
  // a patch of fewer than four triangles has fewer than four candidates to leave out.
  enum class Scope : std::uint8_t { all, of_four_triangles_or_more };
  explicit NormalConeSearch(Scope scope = Scope::all) : scope_(scope) {}
  Scope scope() const { return scope_; }

  // Returns a search that proves patches apart; this object itself searches like a TreeSearch. The
  // first search with proofs finds the contours of all nodes, which takes 0.3 us a triangle.
  // Contours depend only on the mesh and the tree. So all searches of the result REQUIRE the same
  // mesh and the same tree. Beside the descent, a search with proofs takes 0.1 us a triangle for
  // the cones. provable_shares() tries 1 to 8 patches of 96 triangles, 7 us each. If some of these
  // are not free, it also tries up to 16 patches of 36 triangles and 32 of 12 (moving_contour.h), 3
  // us and 1 us each.
  std::unique_ptr<MeshSearch> prepare(const Topology& mesh, const BoundingVolumeTree& tree,
                                      PacedStop& pace) const override;

  // The tests of the scheme. Each can be overridden.
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
  class OfMesh;  // made by prepare()
  Scope scope_;
};

}  // namespace assay::detector
