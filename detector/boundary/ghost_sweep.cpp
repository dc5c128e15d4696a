#include "detector/boundary/ghost_sweep.h"

#include <algorithm>
#include <cmath>

#include "detector/contact/rungs.h"

namespace assay::detector {
namespace {

// The plane of a ghost at rest, in the coordinates of the tree's grid. These are scaled to about 1
// and rounded to floats, which changes each by at most 2^-24 of the greatest of them.
//
// A box for which misses() returns true misses the ghost. Coordinates along axis k of the grid are
// at most S_k in size, and off by d_k = 2^-24 S_k. A side a_k is off by 2 d_k, so n_k = a_m b_n -
// a_n b_m is off by 2 d_m (|a_n| + |b_n|) + 2 d_n (|a_m| + |b_m|) and terms of second order. As
// `wrong` is 2^-22 = 4 2^-24, `of_normal` is twice the terms of first order. At a point x of the
// box the value n.(x - corner) is off by a sum over k. In this sum, the error of n_k is multiplied
// by |x_k - corner_k| <= 2 S_k, and |n_k| by the error of x_k - corner_k, which is at most 2 d_k:
// |n_k| wrong S_k / 2. So slack_ is twice the terms of first order. The terms of second order are
// 2^-22 of these, and the roundings of doubles 2^-28.
class GhostPlane {
 public:
  GhostPlane() = default;
  explicit GhostPlane(const std::array<FloatLanes, 3>& corners) {
    Point size;  // bounds the coordinates of the ghost and of all that the tree holds
    std::array<Point, 2> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      size[k] = 2;
      for (const auto& corner : corners) size[k] = std::max<double>(size[k], std::abs(corner[k]));
      for (std::size_t i = 0; i < 2; ++i) sides[i][k] = double(corners[i + 1][k]) - corners[0][k];
    }
    // A coordinate is wrong by at most 2^-24 size. A side or an offset is at most 2 size long, and
    // wrong by at most 2^-23 size. The products in doubles are wrong by far less. The bound is
    // doubled for terms of second order.
    constexpr double wrong = 0x1p-22;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
      normal_[k] = sides[0][m] * sides[1][n] - sides[0][n] * sides[1][m];
      offset_ += normal_[k] * corners[0][k];
      const double of_normal = wrong * ((std::abs(sides[0][m]) + std::abs(sides[1][m])) * size[n] +
                                        (std::abs(sides[0][n]) + std::abs(sides[1][n])) * size[m]);
      slack_ += of_normal * 2 * size[k] + std::abs(normal_[k]) * wrong * size[k];
    }
  }

  // Returns whether the whole box lies strictly on one side of the plane. If grazing, it may also
  // touch the plane.
  bool misses(const MovingBox& box, bool grazing) const {
    double middle = -offset_, reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double lo = box.lo_t0[k], hi = box.hi_t0[k];
      middle += normal_[k] * (lo + hi) / 2;
      reach += std::abs(normal_[k]) * (hi - lo) / 2;
    }
    if (grazing) return reach > 2 * slack_ && std::abs(middle) >= reach - slack_;
    return std::abs(middle) > reach + slack_;
  }

 private:
  Point normal_ = {0, 0, 0};
  double offset_ = 0, slack_ = 0;
};

class HoleSweep {
 public:
  HoleSweep(std::int32_t top, const GhostSweep& sweep, const HoleTree& hole,
            const StopFunction& stop, std::vector<std::uint8_t>& touched, GhostCounts& counts)
      : top_(top),
        sweep_(sweep),
        tree_(sweep.tree),
        all_(sweep.surface.all()),
        hole_(hole),
        stop_(stop),
        touched_(touched),
        counts_(counts),
        faces_(sweep.motion, sweep.elementary, sweep.piercing_at_start) {
    plan_asking();
  }

  bool run() {
    descend(HoleTree::root, top_);
    return !stopped_;
  }

 private:
  // Descends. Both nodes are split at once, so that their boxes stay of like size.
  void descend(std::size_t of_hole, std::int32_t node) {
    if (stopped_) return;
    ++counts_.box_tests;
    if (counts_.work() >= next_asking_) ask();
    if (apart(hole_.box(of_hole), tree_.box(node))) return;
    const bool splits_hole = !hole_.is_leaf(of_hole);
    // With planes the hole is split down to single ghosts first, because each ghost has a plane of
    // its own, although neighbours in a fan share a side.
    const bool splits_tree =
        !tree_.is_leaf(node) && !(sweep_.by_planes != ByPlanes::no && splits_hole);
    if (sweep_.by_planes != ByPlanes::no && !splits_hole) {
      if (node == top_) plane_ = plane_of(hole_.ghost(of_hole));
      if (plane_.misses(tree_.box(node), sweep_.by_planes == ByPlanes::grazing)) return;
    }
    if (!splits_hole && !splits_tree) {
      test(hole_.ghost(of_hole), tree_.triangle(node));
      return;
    }
    const auto ghosts = splits_hole ? hole_.child(of_hole) : of_hole;
    const auto nodes = splits_tree ? tree_.child(node) : node;
    for (auto g = ghosts; g <= ghosts + splits_hole; ++g) {
      for (auto n = nodes; n <= nodes + splits_tree; ++n) descend(g, n);
    }
  }

  void test(std::int32_t ghost, std::int32_t t) {
    if (counts_.pairs++ == 0) ask();
    if (sweep_.near) (*sweep_.near)[at(t)] = 1;
    if (stopped_ || touched_[at(t)]) return;
    touched_[at(t)] = faces_.meet(all_.triangles[at(ghost)], all_.triangles[at(t)], counts_);
    if (touched_[at(t)] && sweep_.found) sweep_.found->push_back(t);
  }

  GhostPlane plane_of(std::int32_t ghost) const {
    const auto& v = all_.triangles[at(ghost)];
    const auto corner = [&](std::size_t i) {
      return tree_.grid()(sweep_.motion.vertices_t0, v[i]);
    };
    return GhostPlane({corner(0), corner(1), corner(2)});
  }

  void ask() {
    stopped_ = stopped_ || (stop_ && stop_());
    plan_asking();
  }
  // Asks at the next multiple of the interval. The counts go on from hole to hole, so the sweeps of
  // many small holes ask no more often than the sweep of one large hole.
  void plan_asking() {
    next_asking_ = (counts_.work() / sweep_.work_between_stops + 1) * sweep_.work_between_stops;
  }

  const std::int32_t top_;  // of the mesh's tree
  const GhostSweep& sweep_;
  const BoundingVolumeTree& tree_;
  const Topology& all_;
  const HoleTree& hole_;
  const StopFunction& stop_;
  std::vector<std::uint8_t>& touched_;
  GhostCounts& counts_;
  const FacePairTest faces_;
  GhostPlane plane_;
  std::uint64_t next_asking_ = 0;
  bool stopped_ = false;
};

}  // namespace

bool sweep_hole(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
                std::vector<std::uint8_t>& touched, GhostCounts& counts) {
  const auto c = sweep.surface.all().component_of_triangle[at(hole.first_ghost())];
  return sweep_hole_below(sweep.tree.root_of(c), sweep, hole, stop, touched, counts);
}

bool sweep_hole_below(std::int32_t node, const GhostSweep& sweep, const HoleTree& hole,
                      const StopFunction& stop, std::vector<std::uint8_t>& touched,
                      GhostCounts& counts) {
  return HoleSweep(node, sweep, hole, stop, touched, counts).run();
}

HoleTree::HoleTree(const Topology& all, std::span<const std::int32_t> ghosts, const FloatGrid& grid,
                   const SteppedMesh& motion)
    : ghosts_(ghosts), boxes_(2 * ghosts.size() - 1) {
  const std::size_t first_leaf = ghosts.size() - 1;
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const auto& v = all.triangles[static_cast<std::size_t>(ghosts[i])];
    boxes_[first_leaf + i] = box_of(grid(motion, v[0]), grid(motion, v[1]), grid(motion, v[2]));
  }
  for (std::size_t n = first_leaf; n-- > 0;) {
    boxes_[n] = join(boxes_[child(n)], boxes_[child(n) + 1]);
  }
}

std::vector<HoleTree> make_hole_trees(const Topology& all, std::span<const std::int32_t> ghosts,
                                      const FloatGrid& grid, const SteppedMesh& motion) {
  const auto apex = [&](std::size_t i) {
    return all.triangles[static_cast<std::size_t>(ghosts[i])][2];
  };
  std::vector<HoleTree> trees;
  for (std::size_t begin = 0, end = 0; begin < ghosts.size(); begin = end) {
    while (end < ghosts.size() && apex(end) == apex(begin)) ++end;
    trees.emplace_back(all, ghosts.subspan(begin, end - begin), grid, motion);
  }
  return trees;
}

namespace {

bool contains(const FacePairTest::Corners& triangle, std::int32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

}  // namespace

bool FacePairTest::meet(const Corners& a, const Corners& b, GhostCounts& counts) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!contains(b, a[i]) &&
        contact({{path(a[i]), path(b[0]), path(b[1]), path(b[2])}, 1}, counts))
      return true;
    if (!contains(a, b[i]) &&
        contact({{path(b[i]), path(a[0]), path(a[1]), path(a[2])}, 1}, counts))
      return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto u0 = a[i], u1 = a[(i + 1) % 3];
    for (std::size_t j = 0; j < 3; ++j) {
      const auto v0 = b[j], v1 = b[(j + 1) % 3];
      if (u0 == v0 || u0 == v1 || u1 == v0 || u1 == v1) continue;
      if (contact({{path(u0), path(u1), path(v0), path(v1)}, 2}, counts)) return true;
    }
  }
  return pierces_too_ && (pierces(a, b) || pierces(b, a));
}

bool FacePairTest::contact(const FourPoints& query, GhostCounts& counts) const {
  if (separated_along_an_axis(query)) return false;
  ++counts.elementary_tests;
  return elementary_.test(query, Want::yes_no).contact;
}

bool FacePairTest::pierces(const Corners& edges_of, const Corners& face) const {
  const auto start = [&](std::int32_t v) { return motion_.start(v); };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto u = edges_of[i], v = edges_of[(i + 1) % 3];
    if (contains(face, u) || contains(face, v)) continue;
    if (elementary_.pierces(start(u), start(v), {start(face[0]), start(face[1]), start(face[2])})) {
      return true;
    }
  }
  return false;
}

}  // namespace assay::detector
