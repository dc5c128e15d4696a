#include "detector/traditional/moving_contour.h"

#include "tests/detector/traditional/patch_meshes.h"

namespace assay::detector {
namespace {

using tests::flat, tests::Sheet, tests::sheet, tests::triangles;

std::vector<std::int32_t> contour_of(const Triangles& rows, Eigen::Index vertices) {
  const Topology mesh = make_topology(rows, vertices);
  Positions x(vertices, 3);
  for (Eigen::Index i = 0; i < vertices; ++i) x.row(i) << i % 3, i % 5, i % 7;
  const BoundingVolumeTree tree(mesh, x);
  ContourMaker maker(mesh);
  const PatchContours contours(mesh, tree, maker);
  const Contour contour = contours.of(BoundingVolumeTree::root);
  return {contour.begin(), contour.end()};
}

TEST(PatchContours, OnlyOneSimpleWalkIsAContour) {
  EXPECT_EQ(contour_of(triangles({{0, 1, 2}}), 3).size(), 3u);
  EXPECT_EQ(contour_of(triangles({{0, 1, 2}, {2, 1, 3}}), 4).size(), 4u);
  EXPECT_EQ(contour_of(sheet(4, 3, flat).rows, 20).size(), 14u);
  EXPECT_TRUE(contour_of(tests::octahedron(), 6).empty()) << "closed";
  EXPECT_TRUE(contour_of(triangles({{0, 1, 2}, {2, 3, 4}}), 5).empty()) << "joined at a vertex";
  EXPECT_TRUE(contour_of(triangles({{0, 1, 2}, {3, 4, 5}}), 6).empty()) << "two pieces";
  EXPECT_TRUE(contour_of(triangles({{0, 1, 2}, {1, 2, 3}}), 4).empty()) << "turned";
  EXPECT_TRUE(contour_of(triangles({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), 5).empty())
      << "three at an edge";
  const Triangles ring = triangles(
      {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}});
  EXPECT_TRUE(contour_of(ring, 8).empty()) << "a hole";
}

// All cyclic orders start at the least vertex.
std::vector<std::int32_t> from_least(Contour contour) {
  std::vector<std::int32_t> out(contour.begin(), contour.end());
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

TEST(ContourUnion, IsTheContourOfBothTogether) {
  std::mt19937_64 engine(77);
  int joined = 0, apart = 0;
  for (int round = 0; round < 20000; ++round) {
    // Two sets of triangles of a sheet, closed to a tube now and then.
    const std::int32_t n = 2 + static_cast<std::int32_t>(engine() % 3);
    const Sheet whole = sheet(n, n, flat);
    std::vector<std::int32_t> name(static_cast<std::size_t>(whole.x.rows()));
    for (std::size_t v = 0; v < name.size(); ++v) {
      name[v] = static_cast<std::int32_t>(v);
      if (round % 3 == 0 && v % static_cast<std::size_t>(n + 1) == static_cast<std::size_t>(n))
        name[v] -= n;
    }
    std::vector<std::array<std::int32_t, 3>> a, b, both;
    for (Eigen::Index t = 0; t < whole.rows.rows(); ++t) {
      const auto to = engine() % 4;
      if (to == 0) continue;
      std::array<std::int32_t, 3> row;
      for (int k = 0; k < 3; ++k)
        row[static_cast<std::size_t>(k)] = name[static_cast<std::size_t>(whole.rows(t, k))];
      (to == 1 ? a : b).push_back(row);
      both.push_back(row);
    }
    if (a.empty() || b.empty()) continue;
    const auto contour = [&](const std::vector<std::array<std::int32_t, 3>>& rows) {
      Triangles list(static_cast<Eigen::Index>(rows.size()), 3);
      for (std::size_t t = 0; t < rows.size(); ++t)
        list.row(static_cast<Eigen::Index>(t)) << rows[t][0], rows[t][1], rows[t][2];
      return contour_of(list, whole.x.rows());
    };
    const auto of_a = contour(a), of_b = contour(b), of_both = contour(both);
    if (of_a.empty() || of_b.empty()) continue;
    ContourUnion join(static_cast<std::size_t>(whole.x.rows()));
    const Contour found = join.join(of_a, of_b);
    ASSERT_EQ(found.empty(), of_both.empty()) << round;
    if (!found.empty()) {
      EXPECT_EQ(from_least(found), from_least(of_both)) << round;
    }
    (found.empty() ? apart : joined)++;
  }
  EXPECT_GT(joined, 100);
  EXPECT_GT(apart, 100);
}

constexpr int up = 4;  // +z

bool stays_simple(const Positions& x_t0, const Positions& x_t1) {
  std::vector<std::int32_t> walk;
  for (std::int32_t v = 0; v < x_t0.rows(); ++v) walk.push_back(v);
  return MovingContour({x_t0, x_t1}).stays_simple(walk, up);
}

TEST(MovingContour, L13_SeesWhatHappensBetweenTheEnds) {
  EXPECT_EQ(direction(up), (Direction{0, 0, 1}));
  const Positions square = tests::positions({{0, 0, 0}, {1, 0, 5}, {1, 1, -3}, {0, 1, 2}});
  EXPECT_TRUE(stays_simple(square, square));
  EXPECT_TRUE(stays_simple(square, square.array() + 100)) << "a motion as a whole";
  Positions turned = square;  // by 90 degrees
  for (int v = 0; v < 4; ++v) turned.row(v) << -square(v, 1), square(v, 0), square(v, 2);
  EXPECT_TRUE(stays_simple(square, turned));
  EXPECT_FALSE(stays_simple(square, -square)) << "through one point";
  Positions bow = square;
  bow.row(2).swap(bow.row(3));
  EXPECT_FALSE(stays_simple(bow, bow));
  Positions folded = square;
  folded.row(2) << .5, 0, 7;
  EXPECT_FALSE(stays_simple(folded, folded)) << "a vertex on another edge, seen from above";
  const Positions spike = tests::positions({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  EXPECT_FALSE(stays_simple(spike, spike)) << "two edges at a vertex overlap";
  const Positions before =
      tests::positions({{-4, 0, 0}, {4, 0, 0}, {4, 9, 0}, {-3, 1, 0}, {-4, 9, 0}});
  Positions after = before;
  after.row(3) << 3, 1, 0;
  EXPECT_TRUE(stays_simple(before, after));
  // The side turns up and away again: simple at both ends, not in between.
  Positions bulge = before, bulge_after = after;
  bulge.row(0) << -4, -4, 0;
  bulge_after.row(0) << -4, 4, 0;
  bulge.row(1) << 4, 4, 0;
  bulge_after.row(1) << 4, -4, 0;
  bulge.row(3) << -3, -1, 0;
  bulge_after.row(3) << 3, -1, 0;
  EXPECT_TRUE(stays_simple(bulge, bulge));
  EXPECT_TRUE(stays_simple(bulge_after, bulge_after));
  EXPECT_FALSE(stays_simple(bulge, bulge_after));
}

// Random closed walks: where the test says simple, no two edges meet at any of many times.
TEST(MovingContour, L13_SimpleIsNeverSaidOfACrossing) {
  std::mt19937_64 engine(4711);
  int simple = 0, crossing = 0;
  for (int round = 0; round < 20000; ++round) {
    const int n = 3 + static_cast<int>(engine() % 6);
    const int bit = static_cast<int>(engine() % facing_directions);
    const bool is_round = engine() % 2 != 0;  // nearly convex, seen from above
    Positions x_t0(n, 3), x_t1(n, 3);
    const double move = std::ldexp(1.0, -static_cast<int>(engine() % 8));
    for (int v = 0; v < n; ++v) {
      const auto number = [&] { return static_cast<double>(engine() % 17) / 8 - 1; };
      const double a = 2 * std::numbers::pi * v / n;
      for (int k = 0; k < 3; ++k) {
        const double base = is_round ? (k == 0 ? std::cos(a) : k == 1 ? std::sin(a) : 0) : 0;
        x_t0(v, k) = base + (is_round ? .3 : 1) * number();
        x_t1(v, k) = x_t0(v, k) + move * number();
      }
    }
    std::vector<std::int32_t> walk;
    for (std::int32_t v = 0; v < n; ++v) walk.push_back(v);
    if (!MovingContour({x_t0, x_t1}).stays_simple(walk, bit)) {
      ++crossing;
      continue;
    }
    ++simple;
    const Direction d = direction(bit);
    const int m = std::abs(d[0]) == std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) ? 0
                  : std::abs(d[1]) >= std::abs(d[2])                                           ? 1
                                                                                               : 2;
    for (int i = 0; i <= 32; ++i) {
      const double t = i / 32.0;  // and all numbers here are exact, but for the cosines
      using Flat = std::array<double, 2>;
      const auto at = [&](int v) {
        const auto x = [&](int k) { return (1 - t) * x_t0(v, k) + t * x_t1(v, k); };
        const int k = (m + 1) % 3, l = (m + 2) % 3;
        const auto c = [&](int j) { return d[static_cast<std::size_t>(j)]; };
        return Flat{c(m) * x(k) - c(k) * x(m), c(m) * x(l) - c(l) * x(m)};
      };
      const auto turn = [](const Flat& p, const Flat& q, const Flat& r) {
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
      };
      for (int e = 0; e < n; ++e) {
        for (int f = e + 1; f < n; ++f) {
          const Flat p = at(e), q = at((e + 1) % n), r = at(f), s = at((f + 1) % n);
          if ((e + 1) % n == f || (f + 1) % n == e) continue;
          constexpr double margin = 1e-12;
          const bool meet =
              turn(p, q, r) * turn(p, q, s) < -margin && turn(r, s, p) * turn(r, s, q) < -margin;
          EXPECT_FALSE(meet) << round << ", t = " << t << ", edges " << e << " and " << f;
        }
      }
    }
  }
  EXPECT_GT(simple, 1000);
  EXPECT_GT(crossing, 1000);
}

}  // namespace
}  // namespace assay::detector
