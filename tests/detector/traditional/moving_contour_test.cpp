// Contours of moving patches, the directions that patches face, and samples of patches.
#include "detector/traditional/moving_contour.h"

#include "tests/asked.h"
#include "tests/detector/exact/exact_numbers.h"
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
  for (int round = 0; round < tests::usual(20000); ++round) {
    // Two sets of triangles of a sheet, closed to a tube now and then.
    const std::int32_t n = 2 + static_cast<std::int32_t>(engine() % 3);
    const Sheet whole = sheet(n, n, flat);
    std::vector<std::int32_t> name(static_cast<std::size_t>(whole.x.rows()));
    for (std::size_t v = 0; v < name.size(); ++v) {
      name[v] = static_cast<std::int32_t>(v);
      if (round % 3 == 0 && v % static_cast<std::size_t>(n + 1) == static_cast<std::size_t>(n))
        name[v] -= n;
    }
    std::vector<tests::Corners> a, b, both;
    for (Eigen::Index t = 0; t < whole.rows.rows(); ++t) {
      const auto to = engine() % 4;
      if (to == 0) continue;
      tests::Corners row;
      for (int k = 0; k < 3; ++k) row[at(k)] = name[at(whole.rows(t, k))];
      (to == 1 ? a : b).push_back(row);
      both.push_back(row);
    }
    if (a.empty() || b.empty()) continue;
    const auto contour = [&](const std::vector<tests::Corners>& rows) {
      return contour_of(triangles(rows), whole.x.rows());
    };
    const auto of_a = contour(a), of_b = contour(b), of_both = contour(both);
    if (of_a.empty() || of_b.empty()) continue;
    ContourUnion join(static_cast<std::size_t>(whole.x.rows()));
    const Contour found = join.join(of_a, of_b);
    ASSERT_EQ(found.empty(), of_both.empty()) << round;
    EXPECT_EQ(from_least(found), from_least(of_both)) << round;
    (found.empty() ? apart : joined)++;
  }
  EXPECT_GT(joined, tests::usual(100));
  EXPECT_GT(apart, tests::usual(100));
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
  for (int round = 0; round < tests::usual(20000); ++round) {
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

// Directions that a moving triangle faces.

// Directions as exact numbers.
Exact along(const ExactVector& n, int bit) {
  const Direction d = direction(bit);
  return dot(n, {Exact(d[0]), Exact(d[1]), Exact(d[2])});
}

TEST(Facing, L13_WhatIsFacedIsFacedAtEveryTime) {
  std::mt19937_64 engine(1309);
  int faced = 0, unfaced = 0;
  for (int round = 0; round < tests::usual(1500); ++round) {
    // From steps so short that little turns to long ones, with flat and far-off triangles.
    const double move = std::ldexp(1.0, -static_cast<int>(engine() % 40));
    const double offset = engine() % 3 ? 0 : 1e6;
    std::array<MovingPoint, 3> triangle;
    for (auto& p : triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto number = [&] { return static_cast<double>(engine() % 4096) / 2048 - 1; };
        p.t0[k] = offset + (k == 2 && round % 5 == 0 ? 0 : number());
        p.t1[k] = p.t0[k] + move * number();
      }
    }
    const DirectionSet set = faced_directions(triangle);
    const MovingExact e1 = exact_difference(triangle[1], triangle[0]);
    const MovingExact e2 = exact_difference(triangle[2], triangle[0]);
    for (int bit = 0; bit < facing_directions; ++bit) {
      const bool is_faced = (set >> bit & 1) != 0;
      double least = HUGE_VAL;
      bool negative = false;
      constexpr int times = 16;
      for (int i = 0; i <= times; ++i) {
        const Exact t(i / static_cast<double>(times)), s(1 - i / static_cast<double>(times));
        const auto mean = [&](const MovingExact& e) {
          ExactVector out;
          for (std::size_t k = 0; k < 3; ++k) out[k] = s * e.t0[k] + t * e.t1[k];
          return out;
        };
        const Exact value = along(cross(mean(e1), mean(e2)), bit);
        negative |= value.number <= 0;
        least = std::min(least, value.number <= 0 ? 0 : magnitude(value));
      }
      EXPECT_FALSE(is_faced && negative) << round << ", direction " << bit;
      // Short steps leave a margin for the Bernstein coefficients.
      EXPECT_TRUE(is_faced || move >= 0x1p-10 || least <= 0.05) << round;
      (is_faced ? faced : unfaced)++;
    }
  }
  EXPECT_GT(faced, tests::usual(5000));
  EXPECT_GT(unfaced, tests::usual(5000));
}

TEST(Facing, DirectionsAreDistinctAndLeaveNoGap) {
  std::mt19937_64 engine(5);
  for (int i = 0; i < 2000; ++i) {
    Vector v;
    for (double& c : v) c = static_cast<double>(engine() % 20001) / 10000 - 1;
    const Direction d = direction(nearest_direction((DirectionSet{1} << facing_directions) - 1, v));
    EXPECT_GT(dot(d, v) / std::sqrt(dot(d, d) * dot(v, v)), std::cos(23 * std::numbers::pi / 180));
  }
}

// Patches that are sampled.

Topology band(int around, int rows) {
  Triangles t = tests::squares(rows, around);
  // The last column of vertices is the first one.
  t = t.unaryExpr(
      [&](std::int32_t v) { return v / (around + 1) * around + v % (around + 1) % around; });
  return make_topology(t, around * (rows + 1));
}

TEST(SamplePatches, AreOfThreeSizesAndSpreadOverTheMesh) {
  const Topology mesh = band(128, 64);  // 16,384 triangles
  ContourMaker maker(mesh);
  const SamplePatches samples = sample_patches(mesh, maker);
  EXPECT_EQ(samples.small.size(), 32u);
  EXPECT_EQ(samples.medium.size(), 16u);
  EXPECT_EQ(samples.large.size(), 8u);
  for (const auto& [patches, size] :
       {std::pair(&samples.small, 12u), {&samples.medium, 36u}, {&samples.large, 96u}}) {
    std::set<std::int32_t> first_of;
    for (const auto& patch : *patches) {
      EXPECT_EQ(patch.triangles.size(), size);
      EXPECT_EQ(std::set(patch.triangles.begin(), patch.triangles.end()).size(), size);
      EXPECT_FALSE(patch.contour.empty());
      EXPECT_LE(patch.contour.size(), size + 2) << "a disk of n triangles has n + 2 at most";
      first_of.insert(patch.triangles[0] * 8 / 16'384);
    }
    EXPECT_EQ(first_of.size(), 8u) << "in each eighth of the mesh";
  }
}

TEST(SamplePatches, EndWithTheirComponentAndMayHaveNoContour) {
  const Topology tetrahedron =
      make_topology((Triangles(4, 3) << 0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3).finished(), 4);
  ContourMaker maker(tetrahedron);
  const SamplePatches samples = sample_patches(tetrahedron, maker);
  EXPECT_EQ(samples.small.size(), 4u);
  ASSERT_EQ(samples.large.size(), 1u);
  EXPECT_EQ(samples.large[0].triangles.size(), 4u);
  EXPECT_TRUE(samples.large[0].contour.empty()) << "a closed surface has no boundary";
}

}  // namespace
}  // namespace assay::detector
