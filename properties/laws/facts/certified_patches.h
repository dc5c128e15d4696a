// The patches of a step that the traditional scheme certifies, found by the scheme's own tests.
//
// A patch is certified when L13's premise is proved of it: all of its triangles face one direction
// throughout the step, and its contour, projected along that direction, stays a simple polygon.
// The patches looked at are nodes of the detector's tree, from the root down to the largest ones
// that are certified, and unions of two of these that share an edge. A scheme that is wrong in one
// of its tests certifies too much here as well, and L13 shows it.
#pragma once

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "detector/step/stages.h"
#include "detector/traditional/traditional.h"
#include "properties/laws/facts/view_values.h"

namespace assay::properties {

struct CertifiedPatches {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> patch_of;  // by triangle; none: the triangle faces no direction
  std::set<std::pair<std::int32_t, std::int32_t>> unions;  // of two patches, the lower one first
  // How many triangles the largest patch or union has. From 2 on L13 says something.
  std::size_t largest = 0;
  // A triangle faces d when the three Bernstein coefficients of N.d over the step are positive (N
  // its normal, twice its area long). These are the sizes of the coefficients, for the direction
  // of the patch and all of its triangles, over all patches and unions of two triangles or more.
  ValueRange facing;

  // Whether both triangles are in one patch, or in one union of two.
  bool hold(const detector::TrianglePair& pair) const;
};

// The traditional scheme on one mesh.
class TraditionalScheme {
 public:
  // Null if the search of these stages is not one of normal cones. `x` are the positions that the
  // detector is made from: they shape the tree. `mesh` must outlive the result.
  static std::unique_ptr<TraditionalScheme> make(const detector::Stages& stages,
                                                 const detector::Topology& mesh,
                                                 const detector::PositionsView& x);

  // The patches that are certified in this step. As dear as a step of the scheme: 10 us for 20
  // triangles.
  CertifiedPatches certify(const detector::SteppedMesh& motion) const;

  // The pairs of triangles that the scheme's search of this step does not leave out.
  std::set<detector::TrianglePair> candidates(const detector::SteppedMesh& motion);

 private:
  TraditionalScheme(std::shared_ptr<const detector::NormalConeSearch> search,
                    const detector::Topology& mesh, const detector::PositionsView& x);

  std::shared_ptr<const detector::NormalConeSearch> search_;
  const detector::Topology& mesh_;
  detector::BoundingVolumeTree tree_;
  std::unique_ptr<detector::ContourMaker> maker_;
  detector::PatchContours contours_;
};

}  // namespace assay::properties
