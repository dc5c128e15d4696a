// The feature pairs that a search has found near, kept for the next question from the same start.
//
// A line search asks about a step, then about shorter ones in the same direction. These need no
// search: feature pairs that may meet in them were near in the first step.
//
// **L20** *for questions asked again. Let a search over a step leave out only pairs of features
// that are shown to be apart at all times up to T, by boxes with a margin or by fans of vertices
// (vertex_fans.h). Let another step begin at the same places, and let each vertex end within r of
// the place where the first step had it at a time s. Then no pair that was left out meets in the
// other step up to any time u with s u <= T.*
//
// Proof. Both motions are linear and begin at one place. So at the time u of the other step a
// vertex is within r of where it was in the first one, at the time s u. Along axis k let r be
// 2^-26 of the grid's unit, 1 / scale_k (FloatGrid).
//   Boxes that are apart along an axis, with their margin, are ordered by 2^-22 units or more at
//   both ends (FloatGrid::margin), so at all times between; two points take 2^-25 of it away.
//   Sums along a diagonal that are ordered with their margin differ by more than 2^-23 of the
//   common unit, which is the largest (feature_pairs.h); six coordinates take 6 * 2^-26 away.
//   Fans count on positions that are off by e = 2^-23 (vertex_fans.h). Let them be off by e + r:
//   then d = 2^-21 (1 + 2^-4). A component is off by
//     2^-19 (1 + 2^-5) (S_i + S_j) + 2^-41 (1 + 2^-2),
//   and twice the middle coefficient by
//     2^-18 (1 + 2^-5 + 2^-2) (S_i + S_j) + 2^-40 (1 + 2^-2).
//   A third of the bound is left for its own roundings. So no triangle of the fan loses its area in
//   the other step either.
// If features within a distance are asked for, the same holds, because margins go beyond that
// distance.
//
// The ends are compared in doubles. Any s will do, so its own rounding does not matter, nor that of
// T / s: only the place after this share, and the distance to it, are rounded. For coordinates up
// to M both are off by less than 2^-50 M + 2^-1073, as in moving_box.h, and by s times as much if s
// is above 1; but then only times up to 1 / s count, by which a vertex is 1 / s as far off.
// FloatGrid::tolerance() is r less four times as much.
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
  // Searches that find more feature pairs are not kept. Memory: 550 bytes a triangle at most while
  // the lanes of the search list them, 300 afterwards.
  static std::size_t most_features(const Topology& mesh) { return 16 * mesh.triangles.size(); }

  // Drops all that is kept.
  void forget() { until_ = 0; }
  // Returns an empty list for the pairs found next, with the room of the last list.
  std::vector<FeatureKey> take_room() {
    found_.clear();
    return std::exchange(found_, {});
  }
  // Keeps `found`: all feature pairs that a search over the step, with boxes on `grid`, did not
  // show to be apart at all times up to `until` (L20). 2 ns a vertex.
  void keep(const SteppedMesh& step, double until, const FloatGrid& grid,
            std::vector<FeatureKey> found, PacedStop& pace);
  // Returns the time up to which all feature pairs that meet in the other step are among the kept
  // ones (L20). 0: the kept ones say nothing of that step; above 1: they cover more than the step.
  // 2 ns a vertex; the first call takes 5 ns a feature pair, too.
  double covered_until(const SteppedMesh& other, PacedStop& pace);

  // Returns one part of all that is kept. Each part is spread over the mesh. Which pairs a part
  // holds does not depend on the order in which they were found. REQUIRES that it covers a step.
  static constexpr std::size_t parts = 5;
  std::span<const FeatureKey> part(std::size_t i) const {
    return std::span(keys_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }

 private:
  bool follows(const SteppedMesh& other, double share, PacedStop& pace) const;
  bool make_parts(PacedStop& pace);

  Positions x_t0_, x_t1_;
  double until_ = 0;  // 0: nothing is kept
  std::array<double, 3> tolerance_{};
  std::vector<FeatureKey> found_, keys_;  // as they were found, and part by part
  std::array<std::size_t, parts + 1> begins_{};
  // The vertex and axis that move most; set when covered_until() first needs them.
  std::optional<std::pair<Eigen::Index, Eigen::Index>> fastest_;
};

}  // namespace assay::detector
