// The feature pairs that a search has found near, kept for the next question from the same start.
//
// A line search asks about a step, then about shorter ones in the same direction. These need no
// search: what may meet in them was near in the first step.
//
// **L20** *for questions asked again. Let a search over a step leave out those pairs of features
// alone that boxes with a margin show to be apart at all times up to T, or fans of vertices
// (vertex_fans.h). Let another step begin at the same places, and let each vertex end within r of
// the place where the first step had it at a time s <= T. Then what was left out does not meet in
// it.*
//
// Proof. Both motions are linear and begin at one place. So at each time u of the other step a
// vertex is within r of where it was in the first one, at the time s u <= T. Along axis k let r be
// 2^-26 of the grid's unit, 1 / scale_k (FloatGrid).
//   Boxes that are apart along an axis, with their margin, are ordered by 2^-22 units or more at
//   both ends (FloatGrid::margin), so at all times between; two points take 2^-25 of it away.
//   Sums along a diagonal that are ordered with their margin differ by more than 2^-23 of the
//   common unit, which is the largest (feature_pairs.h); six coordinates take 6 * 2^-26 away.
//   Fans count on positions that are off by e = 2^-23 (vertex_fans.h). Let them be off by e + r:
//   then d = 2^-21 (1 + 2^-4). A component is off by
//     2^-19 (1 + 2^-5) (S_i + S_j) + 2^-41 (1 + 2^-3),
//   and twice the middle coefficient by
//     2^-18 (1 + 2^-5 + 2^-2) (S_i + S_j) + 2^-40 (1 + 2^-3).
//   A third of the bound is left for its own roundings. So no triangle of the fan loses its area in
//   the other step either.
// Within a distance the same holds, because margins are beyond it.
//
// The ends are compared in doubles, with s as computed. That is off by less than 2^-50 M + 2^-1073,
// as in moving_box.h, for coordinates up to M, and twice as much is taken from r.
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
  // Searches that find more feature pairs are not kept. In all, 300 bytes a triangle at most.
  static std::size_t most(const Topology& mesh) { return 16 * mesh.triangles.size(); }

  // From now on nothing is kept.
  void forget() { until_ = 0; }
  // An empty list for what is found next, with the room of the last one.
  std::vector<FeatureKey> take_room() {
    found_.clear();
    return std::exchange(found_, {});
  }
  // Keeps what was found near over the step up to this time, with boxes on this grid. 2 ns a
  // vertex.
  void keep(const SteppedMesh& step, double until, const FloatGrid& grid,
            std::vector<FeatureKey> found, PacedStop& pace);
  // Whether all that meets in the other step up to this time is kept (L20). 2 ns a vertex, and the
  // first time 5 ns a feature pair.
  bool cover(const SteppedMesh& other, double until, PacedStop& pace);

  // All that is kept, in parts that each spread over the mesh. Which pairs a part holds does not
  // depend on the order in which they were found. REQUIRES that it covers a step.
  static constexpr std::size_t parts = 5;
  std::span<const FeatureKey> part(std::size_t i) const {
    return std::span(keys_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }

 private:
  bool begins_like(const SteppedMesh& other, double share, PacedStop& pace) const;
  void make_parts();

  Positions x_t0_, x_t1_;
  double until_ = 0;  // 0: nothing is kept
  std::array<double, 3> tolerance_{};
  std::vector<FeatureKey> found_, keys_;  // as they were found, and part by part
  std::array<std::size_t, parts + 1> begins_{};
  // Once another step has been looked at: the coordinate that moves most.
  std::optional<std::pair<Eigen::Index, Eigen::Index>> fastest_;
};

}  // namespace assay::detector
