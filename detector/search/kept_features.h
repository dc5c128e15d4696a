// Keeps the feature pairs that a search has found near, for the next step from the same start.
//
// A line search evaluates a step, and then shorter steps in the same direction. The shorter steps
// need no search, because all feature pairs that meet in them were near in the first step.
//
// **L20** *in detail. Let a search over a first step leave out only pairs of features that are
// shown to be apart at all times up to T, by boxes with a margin or by fans of vertices
// (vertex_fans.h). Let a second step begin at the same places, and let each vertex end within r of
// its place in the first step at a time s. Then no pair that was left out meets in the second step
// up to any time u with s u <= T.*
//
// Proof. Both motions are linear and begin at the same place. So at the time u of the second step a
// vertex is within r of its place in the first step at the time s u. Along axis k let r be 2^-26
// units, where a unit of the grid is 1 / scale_k (FloatGrid).
//   Boxes that are apart along an axis, with their margin, are ordered by 2^-22 units or more at
//   t=0 and at t=1 (FloatGrid::margin), so at all times between. The shifts of two points reduce
//   this by at most 2^-25 units.
//   Sums along a diagonal that are ordered with their margin differ by more than 2^-23 of the
//   common unit, which is the largest unit (feature_pairs.h). The shifts of six coordinates reduce
//   this by at most 6 * 2^-26.
//   Fans assume positions that are off by e = 2^-23 (vertex_fans.h). If positions are off by e + r,
//   then d = 2^-21 (1 + 2^-4). A component is off by
//     2^-19 (1 + 2^-5) (S_i + S_j) + 2^-41 (1 + 2^-2),
//   and twice the middle coefficient by
//     2^-18 (1 + 2^-5 + 2^-2) (S_i + S_j) + 2^-40 (1 + 2^-2).
//   A third of the bound is left for the roundings of the bound itself. So no triangle of the fan
//   loses its area in the second step either.
// This also holds if features within a distance are looked for, because the margins are then larger
// by this distance.
//
// The ends of the two steps are compared in doubles. The law holds for any s, so rounding s or T /
// s does no harm. Only the place in the first step at the time s, and the distance to it, are
// rounded. For coordinates up to M both are off by less than 2^-50 M + 2^-1073, as in moving_box.h,
// and by s times as much if s is above 1. But then only times up to 1 / s count, and by these a
// vertex is off by at most 1 / s as much. FloatGrid::tolerance() is r minus four times 2^-50 M +
// 2^-1073.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "detector/boxes/moving_box.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/types.h"
#include "detector/search/feature_pairs.h"

namespace assay::detector {

class KeptFeatures {
 public:
  // The largest number of feature pairs that are kept; if a search finds more, none is kept.
  // Memory: at most 550 bytes a triangle while the lanes of the search list feature pairs, 300
  // afterwards.
  static std::size_t most_features(const Topology& mesh) { return 16 * mesh.triangles.size(); }

  // Drops the kept feature pairs.
  void forget() { until_ = 0; }
  // Returns an empty list for the feature pairs of the next search, with the memory of the last
  // list.
  std::vector<FeatureKey> take_room() {
    found_.clear();
    return std::exchange(found_, {});
  }
  // Keeps the feature pairs `found`. REQUIRES that these are all feature pairs that a search over
  // the step, with boxes on `grid`, has not shown to be apart at all times up to `until` (L20). 2
  // ns a vertex.
  void keep(const SteppedMesh& step, double until, const FloatGrid& grid,
            std::vector<FeatureKey> found, PacedStop& pace);
  // Returns the time up to which all feature pairs that meet in the step `other` are kept (L20). If
  // it is 0, the kept pairs say nothing about that step; if it is 1 or more, they cover the whole
  // step. 2 ns a vertex; the first call also takes 5 ns a feature pair.
  double covered_until(const SteppedMesh& other, PacedStop& pace);

  // Returns one part of the kept feature pairs. Each part is spread over the whole mesh, and does
  // not depend on the order in which the pairs were found. REQUIRES that covered_until() has
  // returned more than 0.
  static constexpr std::size_t parts = 5;
  std::span<const FeatureKey> part(std::size_t i) const {
    return std::span(keys_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }

 private:
  bool follows(const SteppedMesh& other, double share, PacedStop& pace) const;
  bool make_parts(PacedStop& pace);

  Positions x_t0_, x_t1_;
  double until_ = 0;  // 0: no feature pairs are kept
  std::array<double, 3> tolerance_{};
  // The kept feature pairs: found_ in the order of the search, keys_ sorted by part (see part()).
  std::vector<FeatureKey> found_, keys_;
  std::array<std::size_t, parts + 1> begins_{};
  // The vertex and the axis with the largest motion; set when covered_until() first needs them.
  std::optional<std::pair<Eigen::Index, Eigen::Index>> fastest_;
};

}  // namespace assay::detector
