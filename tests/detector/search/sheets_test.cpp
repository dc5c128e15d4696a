// If sheets are proved apart, no two of their triangles are in contact, by exact arithmetic.
#include "detector/search/sheets.h"

#include "detector/boundary/ghost_sweep.h"
#include "detector/detector.h"
#include "tests/detector/search/search_meshes.h"
#include "tests/detector/traditional/patch_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;

// A mesh with its sheets.
class SheetMesh {
 public:
  SheetMesh(const Triangles& rows, const Positions& x)
      : mesh_(make_topology(rows, x.rows())),
        x_(x),
        tree_(mesh_, x),
        sheets_(mesh_, tree_.wide(), x_, nullptr) {}
  explicit SheetMesh(const MovingMesh& of) : SheetMesh(of.rows(), of.x_t0) {}

  const Sheets& sheets() const { return sheets_; }
  std::int32_t size() const { return static_cast<std::int32_t>(mesh_.triangles.size()); }

  // Looks at all pairs that are proved apart, and at all pairs of nodes. Returns how many pairs of
  // triangles are proved.
  int check() const {
    const auto exact = make_elementary_test(Arithmetic::exact);
    const FacePairTest faces({x_, x_}, *exact, true);
    GhostCounts counts;
    int proved = 0;
    for (std::int32_t a = 0; a < size(); ++a) {
      for (std::int32_t b = 0; b < a; ++b) {
        if (!sheets_.are_apart(a, b)) continue;
        ++proved;
        EXPECT_FALSE(faces.meet(mesh_.triangles[at(a)], mesh_.triangles[at(b)], counts))
            << a << " " << b;
      }
    }
    const auto nodes = static_cast<std::int32_t>(tree_.wide().node_count());
    for (std::int32_t n = 0; n < nodes; ++n) {
      for (std::int32_t m = 0; m <= n; ++m) {
        if (!sheets_.nodes_are_apart(n, m)) continue;
        for (const auto a : below(n)) {
          for (const auto b : below(m)) EXPECT_TRUE(sheets_.are_apart(a, b));
        }
      }
    }
    return proved;
  }

 private:
  std::vector<std::int32_t> below(std::int32_t n) const {
    std::vector<std::int32_t> all;
    const WideTree::Node& node = tree_.wide().node(n);
    for (std::size_t i = 0; i < node.count; ++i) {
      const auto child = tree_.wide().child(node.first_slot + i);
      const auto more = node.holds_triangles ? std::vector{child} : below(child);
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

  const Topology mesh_;
  const Positions x_;
  const BoundingVolumeTree tree_;
  const Sheets sheets_;
};

// A band around the z axis, or a disk for an inner radius of 0, of so many turns, that rises by
// `pitch` a turn; from a height on.
struct Band {
  double inner, outer, turns, pitch, height;
};

class Bands {
 public:
  explicit Bands(int axis = 0, bool upside_down = false)
      : axis_(axis), side_(upside_down ? -1 : 1) {}

  void add(const Band& band, int steps, double jitter, SearchMeshes& random) {
    const bool closes = band.turns == 1 && band.pitch == 0;
    const auto first = static_cast<std::int32_t>(points_.size());
    const int count = closes ? steps : steps + 1;
    const auto shaken = [&](double number) { return number + jitter * random.number(false); };
    for (int i = 0; i < count; ++i) {
      const double share = static_cast<double>(i) / steps,
                   angle = 2 * 3.14159265358979 * band.turns * share;
      for (const double r : {band.inner, band.outer})
        put({side_ * shaken(r * std::cos(angle)), shaken(r * std::sin(angle)),
             shaken(band.height + band.pitch * band.turns * share)});
    }
    const auto hub = static_cast<std::int32_t>(points_.size());
    if (band.inner == 0) put({0, 0, shaken(band.height)});
    for (int i = 0; i < steps; ++i) {
      const auto a = first + 2 * i, b = first + 2 * ((i + 1) % count);
      if (band.inner == 0) {
        rows_.push_back({hub, a + 1, b + 1});
      } else {
        rows_.push_back({a, a + 1, b + 1});
        rows_.push_back({a, b + 1, b});
      }
    }
  }
  SheetMesh mesh() const { return {triangles(rows_), matrix_of<Positions>(points_)}; }

 private:
  void put(const Point& p) {
    Point& turned = points_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) turned[(k + static_cast<std::size_t>(axis_)) % 3] = p[k];
  }

  const int axis_;
  const double side_;
  std::vector<Corners> rows_;
  std::vector<Point> points_;
};

TEST(Sheets, L13_WhatLiesOnceOverThePlaneIsProved) {
  SearchMeshes random(3);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upside_down : {false, true}) {
      Bands bands(axis, upside_down);
      bands.add({0, 1, 1, 0, .5}, 9, .01, random);
      bands.add({1.2, 2, 1, 0, 0}, 40, .01, random);
      bands.add({2.2, 3, .9, 0, 1}, 30, .01, random);
      const SheetMesh mesh = bands.mesh();
      EXPECT_TRUE(mesh.sheets().hold_most());
      EXPECT_TRUE(mesh.sheets().nodes_are_apart(WideTree::root, WideTree::root));
      EXPECT_EQ(mesh.check(), mesh.size() * (mesh.size() - 1) / 2) << axis;
    }
  }
}

// One contour inside another, or around more than once: no two edges of the contours meet.
TEST(Sheets, L13_WhatLiesTwiceOverAPlaceIsNotProved) {
  SearchMeshes random(4);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upside_down : {false, true}) {
      Bands above(axis, upside_down), winding(axis, upside_down);
      above.add({0, 3, 1, 0, 0}, 12, .01, random);
      above.add({1, 2, 1, 0, .2}, 20, .01, random);
      EXPECT_FALSE(above.mesh().sheets().nodes_are_apart(WideTree::root, WideTree::root));
      above.mesh().check();
      winding.add({1, 2, 2.5, .2, 0}, 60, 0, random);
      EXPECT_FALSE(winding.mesh().sheets().nodes_are_apart(WideTree::root, WideTree::root));
      winding.mesh().check();
    }
  }
}

TEST(Sheets, L13_WhatIsProvedIsInNoContact) {
  SearchMeshes random(5);
  int proved = 0, pairs = 0;
  for (int i = 0; i < 300; ++i) {
    Bands bands(i % 3, i % 2 == 0);
    const double jitter = i % 5 == 0 ? 0 : .03 * random.below(8);
    for (int b = 1 + random.below(3); b > 0; --b) {
      const double inner = .5 * random.below(5), turns = 1 + .25 * random.below(5);
      bands.add({inner, inner + .5 + .5 * random.below(3), inner == 0 ? 1 : turns,
                 inner == 0 || turns == 1 ? 0 : .1, .1 * random.below(3)},
                4 + random.below(20), jitter, random);
    }
    const SheetMesh mesh = bands.mesh();
    proved += mesh.check();
    pairs += mesh.size() * (mesh.size() - 1) / 2;
  }
  EXPECT_GT(proved, pairs / 10);
  EXPECT_LT(proved, pairs / 10 * 9);
}

// Of few coordinates: edges in line, triangles without area, vertices upon each other.
TEST(Sheets, L13_OfCoarseCoordinates) {
  SearchMeshes random(6);
  int proved = 0;
  for (int i = 0; i < 2000; ++i) {
    MovingMesh mesh = random.sheets(1 + random.below(2), 1 + random.below(4), i % 2 == 0);
    for (Eigen::Index k = 0; k < mesh.x_t0.size(); ++k) {
      if (random.below(4) == 0) mesh.x_t0.data()[k] += random.number(true);
    }
    proved += SheetMesh(mesh).check();
  }
  EXPECT_GT(proved, 20'000);
}

// Smooth ones that close: six sheets hold all of a sphere; a torus takes those of parts of it too.
TEST(Sheets, L13_OfClosedSurfaces) {
  constexpr int around = 48, along = 24;
  std::vector<Corners> rows;
  std::vector<Point> points;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const double u = 2 * 3.14159265358979 * (j + .01 * i) / around,
                   v = 2 * 3.14159265358979 * i / along, r = 3 - std::cos(v);
      points.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
      const auto at = [&](int ring, int side) { return ring % along * around + side % around; };
      rows.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      rows.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const Sheet ball = sphere(along, 1), torus = {triangles(rows), matrix_of<Positions>(points)};
  for (const auto* surface : {&ball, &torus}) {
    const SheetMesh mesh(surface->rows, surface->x);
    EXPECT_TRUE(mesh.sheets().hold_most());
    EXPECT_FALSE(mesh.sheets().nodes_are_apart(WideTree::root, WideTree::root));
    EXPECT_GT(mesh.check(), mesh.size() * (mesh.size() - 1) / 8);
  }
}

// Two disks with one border, seen from one side: each edge of the border is passed twice one way.
TEST(Sheets, L13_TwoLayersWithOneBorderAreNotProved) {
  const Positions x =
      positions({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {.2, 0, .3}, {-.2, 0, .3}});
  std::vector<Corners> rows;
  for (const std::int32_t hub : {4, 5}) {
    for (std::int32_t i = 0; i < 4; ++i) rows.push_back({i, (i + 1) % 4, hub});
  }
  const SheetMesh mesh(triangles(rows), x);
  EXPECT_FALSE(mesh.sheets().are_apart(0, 4));
  mesh.check();
}

// More edges than are looked at, and something above them.
TEST(Sheets, L13_OfALongContourNothingIsProved) {
  for (const double turn : {0., 1., 2., 3., 4., 5.}) {
    std::vector<Corners> rows;
    std::vector<Point> points;
    const auto add = [&](double x, double y, double z, double size) {
      const auto first = static_cast<std::int32_t>(points.size());
      for (const double angle : {0., 2., 4.})
        points.push_back({x + size * std::cos(turn + angle), y + size * std::sin(turn + angle), z});
      rows.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 200; ++i) add(i % 20, i / 20, 0, .3);
    add(10, 5, 1, 30);
    const SheetMesh mesh(triangles(rows), matrix_of<Positions>(points));
    EXPECT_FALSE(mesh.sheets().nodes_are_apart(WideTree::root, WideTree::root));
    EXPECT_GT(mesh.check(), 0);
  }
}

// In each of its loops: those after it are not begun.
TEST(Sheets, AStopEndsTheSearchForThem) {
  const Topology mesh = make_topology(squares(40, 40), 1681);
  const Positions x = flat_squares(40);
  const BoundingVolumeTree tree(mesh, x);
  for (int last = 1; last < 7; ++last) {
    int calls = 0;
    const StopFunction stop = [&] { return ++calls == last; };
    PacedStop pace(stop, 1000);
    const Sheets sheets(mesh, tree.wide(), x, &pace);
    EXPECT_EQ(calls, last);
    EXPECT_TRUE(pace.stopped());
  }
}

// Large meshes at rest are searched with sheets; what meets is found all the same.
TEST(Sheets, L14_ThePairsOfAMeshAtRestAreThoseOfOneThatHardlyMoves) {
  SearchMeshes random(7);
  for (const double waves : {.05, 3.}) {
    MovingMesh mesh = random.sheets(2, 40, false);
    for (Eigen::Index v = 0; v < mesh.x_t0.rows(); ++v) {
      const double x = mesh.x_t0(v, 0), y = mesh.x_t0(v, 1);
      mesh.x_t0(v, 2) = v < mesh.x_t0.rows() / 2 ? std::sin(.2 * x) * waves : std::sin(.2 * y);
      mesh.x_t0(v, 2) += waves * .01 * random.number(false);
    }
    Positions nearly = mesh.x_t0;
    nearly.row(0) *= 1 + 0x1p-40;
    const auto pairs = [&](const Positions& end) {
      auto detector = Detector::create(mesh.rows(), mesh.x_t0, {Culling::bvh});
      std::vector<TrianglePair> found;
      for (const auto& contact : detector.value().evaluate(mesh.x_t0, end).pairs)
        found.push_back(contact.pair);
      return found;
    };
    const auto at_rest = pairs(mesh.x_t0);
    EXPECT_GT(at_rest.size(), 20u);
    EXPECT_EQ(at_rest, pairs(nearly));
  }
}

}  // namespace
}  // namespace assay::tests
