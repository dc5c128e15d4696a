// Steps of a detector with a separation: which pairs of triangles come within it, and when.
#include "detector/boxes/bounding_volume_tree.h"
#include "detector/detector.h"
#include "detector/distance/nearness.h"
#include "detector/search/feature_pairs.h"
#include "tests/asked.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;

constexpr double largest = std::numeric_limits<double>::max();

Options within(double d, Culling culling = Culling::bvh) {
  return {.culling = culling, .separation = d};
}

StepResult step_within(const Triangles& mesh, const Positions& from, const Positions& to,
                       const Options& options) {
  return Detector::create(mesh, from, options).value().step(from, to);
}

// Whether an edge of `a` goes through triangle `b` at t=0, by signs of volumes in rationals.
bool pierces_at_start(const SteppedMesh& motion, const Corners& a, const Corners& b) {
  std::array<RationalPoint, 3> face;
  for (std::size_t i = 0; i < 3; ++i) face[i] = place_at(motion.path(b[i]), 0);
  const auto volume = [](const RationalPoint& p, const RationalPoint& q, const RationalPoint& r,
                         const RationalPoint& s) {
    const Rational value = dot(minus(q, p), cross(minus(r, p), minus(s, p)));
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalPoint p = place_at(motion.path(a[i]), 0);
    const RationalPoint q = place_at(motion.path(a[(i + 1) % 3]), 0);
    if (volume(p, face[0], face[1], face[2]) * volume(q, face[0], face[1], face[2]) >= 0) continue;
    const int around[3] = {volume(p, q, face[0], face[1]), volume(p, q, face[1], face[2]),
                           volume(p, q, face[2], face[0])};
    if (around[0] != 0 && around[0] == around[1] && around[1] == around[2]) return true;
  }
  return false;
}

// All pairs without a common vertex, by their 15 feature pairs in integers: no boxes, no filter.
std::map<TrianglePair, TimeEnclosure> every_near_pair(const Triangles& mesh,
                                                      const SteppedMesh& motion, double d) {
  std::map<TrianglePair, TimeEnclosure> near;
  for (std::int32_t s = 0; s < mesh.rows(); ++s) {
    for (std::int32_t t = s + 1; t < mesh.rows(); ++t) {
      const Corners a = {mesh(s, 0), mesh(s, 1), mesh(s, 2)};
      const Corners b = {mesh(t, 0), mesh(t, 1), mesh(t, 2)};
      if (std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end()) continue;
      std::optional<TimeEnclosure> first;
      const auto look = [&](const FourPoints& q) {
        const auto time = exact_near_time(q, d);
        if (time && (!first || *time < *first)) first = time;
      };
      for (std::size_t i = 0; i < 3; ++i) {
        const auto path = [&](std::int32_t v) { return motion.path(v); };
        look({{path(a[i]), path(b[0]), path(b[1]), path(b[2])}, 1});
        look({{path(b[i]), path(a[0]), path(a[1]), path(a[2])}, 1});
        for (std::size_t j = 0; j < 3; ++j)
          look({{path(a[i]), path(a[(i + 1) % 3]), path(b[j]), path(b[(j + 1) % 3])}, 2});
      }
      if (pierces_at_start(motion, a, b) || pierces_at_start(motion, b, a))
        first = TimeEnclosure{0, 0};
      if (first) near[{s, t}] = *first;
    }
  }
  return near;
}

void expect_pairs(const StepResult& result, const std::map<TrianglePair, TimeEnclosure>& near) {
  EXPECT_EQ(result.answer, near.empty() ? Answer::free : Answer::collision);
  ASSERT_EQ(result.pairs.size(), near.size());
  std::optional<TimeEnclosure> first;
  for (const PairContact& found : result.pairs) {
    ASSERT_TRUE(near.contains(found.pair)) << found.pair.a << ' ' << found.pair.b;
    EXPECT_EQ(found.time, near.at(found.pair)) << found.pair.a << ' ' << found.pair.b;
    if (!first || found.time < *first) first = found.time;
  }
  EXPECT_EQ(result.first, first.value_or(result.first));
}

TEST(SeparationStep, L16_RandomStepsAgainstEveryPair) {
  std::mt19937_64 engine(41);
  const auto below = [&](int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); };
  std::size_t near = 0, at_start = 0, apart = 0;
  for (int round = 0; round < tests::usual(150); ++round) {
    // A closed strip of triangles in tatters, on small integers, and some triangles beside it.
    constexpr Eigen::Index vertices = 12;
    Positions from(vertices, 3), to(vertices, 3);
    const int reach = 3 + below(round % 2 == 0 ? 12 : 60);
    for (Eigen::Index i = 0; i < 3 * vertices; ++i) {
      from.data()[i] = below(2 * reach) - reach;
      to.data()[i] = round % 3 == 0 ? below(2 * reach) - reach : from.data()[i] + below(5) - 2;
    }
    if (round % 5 == 0) to = from;
    const Triangles mesh =
        triangles({{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 5, 6}, {7, 8, 9}, {9, 8, 10}, {6, 5, 11}});
    const double d = below(4) == 0 ? 0.5 : 1 + below(3);
    const auto expected = every_near_pair(mesh, {from, to}, d);
    for (const Culling culling : {Culling::bvh, Culling::none}) {
      const StepResult result = step_within(mesh, from, to, within(d, culling));
      ASSERT_NO_FATAL_FAILURE(expect_pairs(result, expected)) << "round " << round;
    }
    near += expected.size();
    for (const auto& [pair, time] : expected) at_start += time.hi == 0;
    constexpr std::size_t pairs_without_a_common_vertex = 15;
    apart += pairs_without_a_common_vertex - expected.size();
  }
  EXPECT_GT(at_start, tests::usual(100));
  EXPECT_GT(near - at_start, tests::usual(100));
  EXPECT_GT(apart, tests::usual(100));
}

// Triangle 1 goes through triangle 0, and all features are far from each other. The longer ones are
// neighbours of either.
TEST(SeparationStep, L16_PiercingAtTheStartCounts) {
  const Positions x =
      positions({{-40, -30, 0}, {40, -30, 0}, {0, 50, 0}, {0, 0, 30}, {0, 0, -30}, {60, 0, 90}});
  const auto result = step_within(triangles({{0, 1, 2}, {3, 4, 5}}), x, x, within(1));
  ASSERT_EQ(result.pairs.size(), 1u);
  EXPECT_EQ(result.first, (TimeEnclosure{0, 0}));
  EXPECT_EQ(result.pairs[0].feature.kind, FeatureKind::piercing);
}

// A fan: triangles 0 and 1 share an edge, 0 and 2 a vertex. All are near each other at every time,
// and none of these pairs counts.
TEST(SeparationStep, L16_NeighboursDoNotCount) {
  const Positions x = positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}});
  const Triangles fan = triangles({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  EXPECT_EQ(step_within(fan, x, x, within(100)).answer, Answer::free);
}

// A feature pair is tested at one pair of triangles, but counts for all that hold it: here the
// triangles that represent the vertex and the edge share a vertex, and others that hold them do
// not.
TEST(SeparationStep, L16_HoldersThatShareNoVertexCount) {
  const Positions x =
      positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, .25}, {2, 1, .5}, {2, 2, .5}});
  const Triangles strip = triangles({{0, 1, 2}, {1, 3, 2}, {1, 4, 3}, {4, 5, 3}});
  const auto result = step_within(strip, x, x, within(.8));
  const auto expected = every_near_pair(strip, {x, x}, .8);
  EXPECT_FALSE(expected.empty());
  expect_pairs(result, expected);
}

TEST(SeparationStep, ThreadsDoNotShow) {
  const auto mesh = SearchMeshes(12).sheets(2, 24, false);
  const Triangles rows = mesh.rows();
  const Positions end = .97 * mesh.x_t0 + .03 * mesh.x_t1;
  const auto alone = step_within(rows, mesh.x_t0, end, within(.05));
  EXPECT_GT(alone.pairs.size(), 100u);
  for (const std::uint32_t threads : {2u, 3u}) {
    const auto shared = step_within(
        rows, mesh.x_t0, end, {.culling = Culling::bvh, .threads = threads, .separation = .05});
    expect_same_work(shared, alone);
    EXPECT_EQ(shared.counts.narrow.rungs.total(), alone.counts.narrow.rungs.total());
  }
}

// A detector answers each step by itself, whatever it has committed before.
TEST(SeparationStep, StepsDoNotDependOnEarlierOnes) {
  const auto mesh = SearchMeshes(13).sheets(2, 5, true);
  const Triangles rows = mesh.rows();
  for (const Start start : all_values<Start>) {
    const Options options{.culling = Culling::bvh, .start = start, .separation = .5};
    auto detector = std::move(Detector::create(rows, mesh.x_t0, options).value());
    detector.step(mesh.x_t0, mesh.x_t1);
    expect_same_contacts(detector.step(mesh.x_t1, mesh.x_t0),
                         step_within(rows, mesh.x_t1, mesh.x_t0, within(.5)));
  }
}

TEST(SeparationStep, ASeparationOfZeroAsksForContacts) {
  const Positions x = octahedron_positions(2);
  for (const double none : {0.0, -0.0})
    expect_same_contacts(step_within(octahedron(), x, pushed_octahedron(), within(none)),
                         step_within(octahedron(), x, pushed_octahedron(), {Culling::view_point}));
}

// Two triangles one above the other, far away or near, at the ends of the range of doubles.
TEST(SeparationStep, L16_DistancesOfAnySize) {
  const Triangles two = triangles({{0, 1, 2}, {3, 4, 5}});
  const auto above = [](double size, double height) {
    Positions x = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    x *= size;
    x.bottomRows(3).col(2).setConstant(height);
    return x;
  };
  const auto is_near = [&](const Positions& x, double d) {
    return step_within(two, x, x, within(d)).answer == Answer::collision;
  };
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  for (const double d : {smallest, 0x1p-1060, 1e-300, 1e-20, 1.0, 1e20, 1e300, largest}) {
    for (const double size : {smallest, 1e-300, 1.0, 1e300, largest}) {
      EXPECT_TRUE(is_near(above(size, d), d)) << d << ' ' << size;
      EXPECT_FALSE(d < largest && is_near(above(size, std::nextafter(d, largest)), d))
          << d << ' ' << size;
    }
  }
}

TEST(SeparationStep, WrongSeparationsAreRefusedByName) {
  const Positions x = octahedron_positions(2);
  const auto refusal = [&](const Options& options) {
    const auto result = Detector::create(octahedron(), x, options);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().error, InputError::wrong_separation);
    return result.error().message;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double d : {-1.0, infinity, std::nan("")})
    EXPECT_EQ(refusal(within(d)), "the separation is negative or not finite");
  for (const Culling culling : all_values<Culling>) {
    if (culling == Culling::bvh || culling == Culling::none) continue;
    EXPECT_EQ(refusal(within(1, culling)), std::string("culling ") + name_of(culling) +
                                               " supports no separation; use `bvh` or `none`");
  }
  for (const Arithmetic arithmetic : all_values<Arithmetic>) {
    if (arithmetic == Arithmetic::exact) continue;
    EXPECT_TRUE(says(refusal({.culling = Culling::bvh, .arithmetic = arithmetic, .separation = 1}),
                     name_of(arithmetic)));
  }
}

// What margins tell apart is farther apart than the separation, along an axis or a diagonal.
TEST(SeparationStep, L16_MarginsOfBoxes) {
  constexpr std::array<std::array<int, 3>, 7> directions = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}};
  std::mt19937_64 engine(5);
  const auto below = [&](std::uint64_t n) { return static_cast<double>(engine() % n); };
  std::size_t told_apart = 0, close = 0;
  for (int round = 0; round < 6000; ++round) {
    double d = std::ldexp(1 + below(3), -static_cast<int>(engine() % 12));
    Positions x[2] = {Positions(4, 3), Positions(4, 3)};
    for (auto& frame : x) {
      for (Eigen::Index i = 0; i < 12; ++i) {
        double& c = frame.data()[i];
        if (round % 4 == 0) c = below(5) - 2;
        if (round % 4 == 1) c = below(1 << 20) * 0x1p-19 - 1;
        if (round % 4 == 2) c = (below(3) - 1) * d + (below(9) - 4) * 0x1p-21;
        if (round % 4 == 3) c = (below(5) - 2) * (largest / 2);
      }
    }
    if (round % 4 == 3) d *= 0x1p1020;
    const FeaturePoints points({x[0], x[1]}, nullptr, d);
    const bool is_apart = are_apart(points, {0, 0}, {1, 1}, points.margin());
    bool is_farther = false;
    for (const auto& n : directions) {
      const auto gap = [&](const Positions& frame) {
        Rational sum = 0;
        for (int k = 0; k < 3; ++k)
          sum += n[static_cast<std::size_t>(k)] * (Rational(frame(0, k)) - Rational(frame(1, k)));
        return sum;
      };
      const Rational from = gap(x[0]), to = gap(x[1]),
                     square = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
      if ((from > 0) != (to > 0)) continue;
      is_farther |= from * from > square * squared(d) && to * to > square * squared(d);
    }
    EXPECT_TRUE(!is_apart || is_farther) << round;
    told_apart += is_apart;
    close += is_farther && !is_apart;
  }
  EXPECT_GT(told_apart, 500u);
  EXPECT_GT(close, 20u);
  // The boxes of a tree are grown by half of the margin.
  const Positions y = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}, {1, 0, 3}, {0, 1, 3}});
  const Triangles two = triangles({{0, 1, 2}, {3, 4, 5}});
  BoundingVolumeTree tree(make_topology(two, 6), y);
  for (const auto& [distance, meet] :
       {std::pair(2.999, false), std::pair(3.0, true), std::pair(1e300, true)}) {
    tree.grow_boxes(distance);
    tree.refit(make_topology(two, 6), {y, y});
    tree.join_boxes(nullptr);
    EXPECT_EQ(!apart(tree.box(tree.leaf_of(0)), tree.box(tree.leaf_of(1))), meet) << distance;
  }
}

}  // namespace
}  // namespace assay::tests
