// Boxes in floats: if they find two features apart, the features are apart in doubles and at all
// times.
#include "detector/boxes/moving_box.h"

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/paced_stop.h"
#include "detector/parallel/workers.h"
#include "tests/detector/points.h"

namespace assay::tests {
namespace {

using namespace detector;

constexpr double denormal = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

// Coordinates of one family, with neighbours of each.
std::vector<double> numbers(std::initializer_list<double> seeds) {
  std::vector<double> out;
  for (const double x : seeds) {
    out.insert(out.end(), {x, -x, std::nextafter(x, 0), -std::nextafter(x, 0)});
    if (std::abs(x) < largest) out.push_back(std::nextafter(x, largest));
  }
  return out;
}

const std::vector<std::vector<double>>& families() {
  static const std::vector<std::vector<double>> all = {
      numbers({0, 1, .5, 1. / 3, 2, 3}),
      numbers({0, denormal, 3 * denormal, 0x1p-1060, 0x1p-1022}),
      numbers({1, 0x1p1000, largest, largest / 2, 0x1.8p1023}),
      numbers({1e9, 1e9 + 1, 1e9 + .125, 1e9 + 1e-6}),
      numbers({0, denormal, 1e-300, 1e-40, 1, 1e30, 1e300, largest}),
  };
  return all;
}

struct RandomPoints {
  RandomPoints(const std::vector<double>& from, Eigen::Index count, std::mt19937_64& engine)
      : x_t0(count, 3), x_t1(count, 3) {
    for (auto* x : {&x_t0, &x_t1}) {
      for (Eigen::Index v = 0; v < count; ++v) {
        for (Eigen::Index k = 0; k < 3; ++k) (*x)(v, k) = from[engine() % from.size()];
      }
    }
  }
  // Strictly ordered along an axis in one sense at both ends, as doubles.
  bool ordered(std::int32_t a, std::int32_t b) const {
    for (int k = 0; k < 3; ++k) {
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, a)}) {
        if (x_t0(p, k) < x_t0(q, k) && x_t1(p, k) < x_t1(q, k)) return true;
      }
    }
    return false;
  }
  Positions x_t0, x_t1;
};

TEST(MovingBox, RoundingKeepsOrder) {
  for (const auto& family : families()) {
    const auto n = static_cast<Eigen::Index>(family.size());
    Positions x(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) x.row(i).setConstant(family[static_cast<std::size_t>(i)]);
    // Also of a step that holds only part of them.
    for (const auto rows : {n, n / 2}) {
      const FloatGrid f({x.topRows(rows), x.topRows(rows)});
      for (std::int32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_FALSE(std::isnan(f(x, i)[k]));
        for (std::int32_t j = 0; j < n; ++j)
          EXPECT_TRUE(x(i, 0) > x(j, 0) || f(x, i)[0] <= f(x, j)[0]) << x(i, 0) << " " << x(j, 0);
      }
    }
  }
}

// A vertex of one box and one of the other, for boxes that are apart: strictly ordered in doubles.
TEST(MovingBox, L3_ApartIsApartInDoubles) {
  std::mt19937_64 engine(1);
  std::size_t told_apart = 0, touching = 0;
  for (const auto& family : families()) {
    for (int round = 0; round < 400; ++round) {
      const RandomPoints p(family, 4, engine);
      const RoundedPositions points({p.x_t0, p.x_t1});
      const bool is_apart = apart(points.box({0, 1, 1}), points.box({2, 3, 3}));
      told_apart += is_apart;
      for (std::int32_t i = 0; i < 2; ++i) {
        for (std::int32_t j = 2; j < 4; ++j) {
          EXPECT_TRUE(!is_apart || p.ordered(i, j));
          touching += !p.ordered(i, j);
        }
      }
    }
  }
  EXPECT_GT(told_apart, 50u);
  EXPECT_GT(touching, 1000u);
}

TEST(MovingBox, TouchingIsNotApart) {
  const Positions x = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}});
  const RoundedPositions still({x, x});
  EXPECT_FALSE(apart(still.box({0, 1, 2}), still.box({3, 4, 5})));
  Positions away = x;
  away.bottomRows(3).col(0).array() += 0x1p-20;
  EXPECT_FALSE(apart(RoundedPositions({x, away}).box({0, 1, 2}),
                     RoundedPositions({x, away}).box({3, 4, 5})));
  EXPECT_TRUE(apart(RoundedPositions({away, away}).box({0, 1, 2}),
                    RoundedPositions({away, away}).box({3, 4, 5})));
}

// Two triangles change places: ordered at both ends, but not in the same sense.
TEST(MovingBox, PassingEachOtherIsNotApartAndMovingTogetherIs) {
  const Positions x = positions({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}, {5, 1, 0}, {5, 0, 1}});
  Positions swapped(6, 3);
  swapped << x.bottomRows(3), x.topRows(3);
  const RoundedPositions passing({x, swapped});
  EXPECT_FALSE(apart(passing.box({0, 1, 2}), passing.box({3, 4, 5})));
  // Far along, side by side: swept boxes would meet.
  Positions moved = x;
  moved.col(0).array() += 100;
  const RoundedPositions together({x, moved});
  EXPECT_TRUE(apart(together.box({0, 1, 2}), together.box({3, 4, 5})));
}

void expect_same_box(const MovingBox& a, const MovingBox& b, const char* which) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(a.lo_t0[k], b.lo_t0[k]) << which;
    EXPECT_EQ(a.hi_t0[k], b.hi_t0[k]) << which;
    EXPECT_EQ(a.lo_t1[k], b.lo_t1[k]) << which;
    EXPECT_EQ(a.hi_t1[k], b.hi_t1[k]) << which;
  }
}

// Boxes of nodes hold those of the triangles below, wherever the mesh lies.
TEST(MovingBox, NodesHoldTheirTriangles) {
  std::mt19937_64 engine(2);
  for (const auto& family : families()) {
    const RandomPoints p(family, 30, engine);
    Triangles list(28, 3);
    for (Eigen::Index t = 0; t < 28; ++t) list.row(t) << t, t + 1, t + 2;
    const Topology mesh = make_topology(list, 30);
    BoundingVolumeTree tree(mesh, p.x_t0);
    tree.refit(mesh, {p.x_t0, p.x_t1});
    tree.join_boxes(nullptr);
    ASSERT_EQ(tree.node_count(), 55u);
    for (std::int32_t t = 0; t < 28; ++t) {
      const MovingBox box =
          tree.box_of_triangle(mesh.triangles[static_cast<std::size_t>(t)], {p.x_t0, p.x_t1});
      std::int32_t node = tree.leaf_of(t);
      ASSERT_EQ(tree.triangle(node), t);
      expect_same_box(box, tree.box(node), "of a leaf it is the box");
      for (;; node = tree.parent(node)) {
        expect_same_box(join(tree.box(node), box), tree.box(node), "of a node");
        if (node == BoundingVolumeTree::root) break;
      }
    }
  }
}

// A large component is cut by planes that halve a sample: every triangle has one leaf, below nodes
// that are numbered as those of a small one, however uneven the parts are.
TEST(MovingBox, LargeMeshesAreCutTheSameForAnyNumberOfThreads) {
  constexpr Eigen::Index count = 80'000, corners = count + 2;
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> place(0, 1);
  for (const double share : {0., .5, .999, 1.}) {  // of the vertices: those that stand at one place
    Positions x = Positions::NullaryExpr(corners, 3, [&] { return place(engine); });
    x.topRows(static_cast<Eigen::Index>(share * corners)).setConstant(.25);
    Triangles list(count, 3);
    for (Eigen::Index t = 0; t < count; ++t) list.row(t) << t, t + 1, t + 2;
    const Topology mesh = make_topology(list, corners);
    const BoundingVolumeTree tree(mesh, x);
    std::vector<int> depth(tree.node_count());
    for (std::int32_t node = 0; at(node) < tree.node_count(); ++node) {
      if (node != 0) depth[at(node)] = depth[at(tree.parent(node))] + 1;
      EXPECT_LE(depth[at(node)], 26);
      if (tree.is_leaf(node)) {
        ASSERT_EQ(tree.leaf_of(tree.triangle(node)), node);
      } else {
        ASSERT_GT(tree.child(node), node);
        ASSERT_EQ(tree.parent(tree.child(node)), node);
        ASSERT_EQ(tree.parent(tree.child(node) + 1), node);
      }
    }
    for (const std::uint32_t threads : {2u, 5u}) {
      const Workers workers(threads);
      PacedStop pace(never_stops, workers);
      const BoundingVolumeTree shared(mesh, x, &pace);
      for (std::int32_t node = 0; at(node) < tree.node_count(); ++node)
        ASSERT_EQ(shared.child(node), tree.child(node)) << share << " " << threads;
    }
  }
}

// One power of two for all axes brings every position of the step near 1: that of the longest.
TEST(MovingBox, BoxesAreFittedOnceToTheArraysOfAStep) {
  Positions x(4, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  Triangles sheet(2, 3);
  sheet << 0, 1, 2, 1, 3, 2;
  const Topology mesh = make_topology(sheet, 4);
  BoundingVolumeTree tree(mesh, x);
  Positions moved = x.rowwise() + Eigen::RowVector3d(0, 0, 1);
  const SteppedMesh step = {x, moved}, still = step.at_start();
  PacedStop never(never_stops);
  const auto top = [&] {
    tree.join_boxes(nullptr);
    return tree.box(BoundingVolumeTree::root).hi_t1;
  };
  const auto same = [](FloatLanes a, FloatLanes b) { return !any(a != b); };
  ASSERT_TRUE(tree.fit_once(mesh, step, never));
  const auto fitted = top();
  ASSERT_TRUE(tree.fit_once(mesh, still, never));
  EXPECT_FALSE(same(top(), fitted)) << "another array of t=1";
  ASSERT_TRUE(tree.fit_once(mesh, step, never));
  EXPECT_TRUE(same(top(), fitted));
  // Two views that begin at one place, with rows of three numbers and with rows that overlap.
  using Stride = Eigen::OuterStride<>;
  using View = Eigen::Map<const Positions, 0, Stride>;
  const View all(x.data(), 4, 3, Stride(3)), overlapping(x.data(), 4, 3, Stride(1));
  ASSERT_TRUE(tree.fit_once(mesh, {all, all}, never));
  const auto at_rest = top();
  ASSERT_TRUE(tree.fit_once(mesh, {all, overlapping}, never));
  EXPECT_FALSE(same(top(), at_rest)) << "the same places, other strides";
  ASSERT_TRUE(tree.fit_once(mesh, step, never));
  moved.col(2).setConstant(0.75);
  ASSERT_TRUE(tree.fit_once(mesh, step, never));
  EXPECT_TRUE(same(top(), fitted)) << "the same arrays are not looked at again";
  tree.forget_fit();
  ASSERT_TRUE(tree.fit_once(mesh, step, never));
  EXPECT_FALSE(same(top(), fitted));
  const StopFunction always = [] { return true; };
  tree.forget_fit();
  PacedStop stopping(always);
  while (!stopping.after(1'000'000)) {
  }
  EXPECT_FALSE(tree.fit_once(mesh, step, stopping));
  EXPECT_FALSE(tree.fit_once(mesh, step, stopping)) << "what was stopped is not fitted";
}

TEST(FloatGrid, ScalesAllAxesByTheLongest) {
  for (Eigen::Index longest = 0; longest < 3; ++longest) {
    Positions x = positions({{-1, -1, -1}, {1, 1, 1}});
    x.col(longest) *= 1000;
    const FloatGrid grid({x, x});
    for (std::int32_t v = 0; v < 2; ++v) {
      for (const double y : grid.scaled(x, v)) EXPECT_LE(std::abs(y), 2) << longest;
    }
  }
}

// The bounds that several threads found are put together, wherever the least and the greatest are.
TEST(FloatGrid, IsTheSameForAnyNumberOfThreads) {
  constexpr Eigen::Index count = 500'000;  // so many that all threads take some
  for (const Eigen::Index extreme : {Eigen::Index{1}, count / 2, count - 1}) {
    for (const double far : {-1000., 1000.}) {
      Positions x = Positions::Constant(count, 3, .25);
      x(extreme, 1) = far;
      const FloatGrid alone({x, x});
      for (const std::uint32_t threads : {2u, 3u, 8u}) {
        const Workers workers(threads);
        PacedStop pace(never_stops, workers);
        const FloatGrid shared({x, x}, &pace);
        for (const std::int32_t v : {0, static_cast<std::int32_t>(extreme)})
          EXPECT_EQ(shared.scaled(x, v), alone.scaled(x, v)) << extreme << " " << threads;
      }
    }
  }
}

}  // namespace
}  // namespace assay::tests
