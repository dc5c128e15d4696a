// Feature pairs at representatives: the feature pairs of all candidates are found, each once,
// closure rounds included. Also the points that are compared to find these pairs.
#include "detector/search/feature_pairs.h"

#include <boost/multiprecision/cpp_int.hpp>

#include "detector/detector.h"
#include "detector/search/candidate_search.h"
#include "detector/search/search_lanes.h"
#include "tests/asked.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;
using Rational = boost::multiprecision::cpp_rational;

// A box along axes and diagonals at both ends of the step, in the order of FeaturePoint.
constexpr std::size_t floats_of_both = 2 * floats_of_corner;
float float_of(const FeaturePoints& points, std::int32_t v, std::size_t k) {
  const bool at_start = k < floats_of_corner;
  return (at_start ? points.start(v) : points.end(v)).floats()[k % floats_of_corner];
}
struct Box {
  std::array<float, floats_of_both> lo, hi;

  static Box of(const FeaturePoints& points, std::span<const std::int32_t> vertices) {
    Box box;
    for (std::size_t k = 0; k < floats_of_both; ++k) {
      box.lo[k] = box.hi[k] = float_of(points, vertices[0], k);
      for (const auto v : vertices) {
        box.lo[k] = std::min(box.lo[k], float_of(points, v, k));
        box.hi[k] = std::max(box.hi[k], float_of(points, v, k));
      }
    }
    return box;
  }

  static bool apart(const Box& a, const Box& b, const FeatureMargin& margin, bool at_start) {
    constexpr std::size_t lanes = floats_of_corner;
    for (std::size_t k = 0; k < lanes; ++k) {
      const float by = margin.floats()[k];
      const auto below = [&](const Box& p, const Box& q, std::size_t i) {
        return p.hi[i] + by < q.lo[i];
      };
      if (below(a, b, k) && (at_start || below(a, b, k + lanes))) return true;
      if (below(b, a, k) && (at_start || below(b, a, k + lanes))) return true;
    }
    return false;
  }
};

// All feature pairs of a triangle pair whose boxes are not apart, by the definition.
class BruteForce {
 public:
  explicit BruteForce(const MovingMesh& mesh)
      : mesh_(mesh.topology), points_({mesh.x_t0, mesh.x_t1}) {}

  void add(std::int32_t a, std::int32_t b, bool may_pierce, std::set<FeatureKey>& out) const {
    add_one_way(a, b, may_pierce, out);
    add_one_way(b, a, may_pierce, out);
    for (const auto e : mesh_.triangle_edges[at(a)]) {
      for (const auto f : mesh_.triangle_edges[at(b)]) {
        const auto &u = mesh_.edges[at(e)], &v = mesh_.edges[at(f)];
        if (u[0] == v[0] || u[0] == v[1] || u[1] == v[0] || u[1] == v[1]) continue;
        if (apart(edge_box(e), edge_box(f))) continue;
        out.insert(key_of(FeatureKind::edge_edge, std::min(e, f), std::max(e, f)));
      }
    }
  }

 private:
  Box edge_box(std::int32_t e) const { return Box::of(points_, mesh_.edges[at(e)]); }
  bool apart(const Box& a, const Box& b, bool at_start = false) const {
    return Box::apart(a, b, points_.margin(), at_start);
  }
  void add_one_way(std::int32_t a, std::int32_t b, bool may_pierce,
                   std::set<FeatureKey>& out) const {
    const auto& face = mesh_.triangles[at(b)];
    const Box face_box = Box::of(points_, face);
    const auto holds = [&](std::int32_t v) {
      return std::find(face.begin(), face.end(), v) != face.end();
    };
    for (const auto v : mesh_.triangles[at(a)]) {
      if (holds(v) || apart(Box::of(points_, {&v, 1}), face_box)) continue;
      out.insert(key_of(FeatureKind::vertex_face, v, b));
    }
    for (const auto e : mesh_.triangle_edges[at(a)]) {
      if (!may_pierce || holds(mesh_.edges[at(e)][0]) || holds(mesh_.edges[at(e)][1])) continue;
      if (apart(edge_box(e), face_box) || apart(edge_box(e), face_box, true)) continue;
      out.insert(key_of(FeatureKind::piercing, e, b));
    }
  }
  const Topology& mesh_;
  FeaturePoints points_;
};

// A search of its own beside the one under test: every triangle pair that is asked for.
class Sequence {
 public:
  Sequence(SearchMeshes& random, const MovingMesh& mesh)
      : random_(random),
        mesh_(mesh),
        tree_(mesh.topology, mesh.x_t0),
        memory_(tree_),
        pairs_(mesh.topology, memory_.representatives, memory_.marks.types),
        brute_force_(mesh) {
    tree_.refit(mesh.topology, {mesh.x_t0, mesh.x_t1});
    memory_.representatives.make(mesh.topology, memory_.marks.types, nullptr);
    pairs_.fit({mesh.x_t0, mesh.x_t1}, nullptr, 0);
  }

  void mark(const std::vector<TriangleType>& types) {
    MarkingCounts counts;
    Marking().bring_to(types, tree_, memory_.marks, counts);
    memory_.representatives.update(mesh_.topology, memory_.marks.types, memory_.marks.changed);
  }

  // Every feature pair found is new in this step; returns how many.
  std::size_t search(const PairTables& tables) {
    const Topology& mesh = mesh_.topology;
    const auto& types = memory_.marks.types;
    const auto may_pierce = [&](std::int32_t a, std::int32_t b) {
      return mesh.component_of_triangle[at(a)] != mesh.component_of_triangle[at(b)] ||
             (types[at(a)] == TriangleType::dirty && types[at(b)] == TriangleType::dirty);
    };
    const SearchInput input{mesh, tree_, memory_.marks, tables};
    SearchCounts counts;
    std::vector<FeatureKey> found;
    WideSearch().search(input, counts, [&](std::int32_t a, std::int32_t b) {
      const std::size_t before = found.size();
      if (random_.below(2)) std::swap(a, b);
      pairs_.append(a, b, may_pierce(a, b), found);
      EXPECT_LE(found.size() - before, FeaturePairs::max_keys);
      return true;
    });
    std::set<FeatureKey> expected;
    ExhaustiveSearch().search(input, counts, [&](std::int32_t a, std::int32_t b) {
      brute_force_.add(a, b, may_pierce(a, b), expected);
      return true;
    });
    std::set<FeatureKey> fresh;
    for (const auto key : expected) {
      if (keys_.insert(key).second) fresh.insert(key);
    }
    EXPECT_EQ(std::set<FeatureKey>(found.begin(), found.end()), fresh);
    EXPECT_EQ(found.size(), fresh.size()) << "some feature pair twice";
    return found.size();
  }

  // A step: K, then rounds of the closure in which random triangles join H.
  std::size_t step(const PairRule& rule, const std::vector<TriangleType>& start) {
    keys_.clear();
    mark(start);
    std::vector<TriangleType> types = start;
    pairs_.ask(AskedTypes::in_first_search(rule.candidates()));
    std::size_t found = search(rule.candidates());
    pairs_.ask(AskedTypes::in_closure(rule.candidates(), rule.closure()));
    for (int round = 0; round < 3; ++round) {
      for (auto& type : types) {
        if (type == TriangleType::positive_grown) type = TriangleType::positive_joined;
        if (type == TriangleType::negative_grown) type = TriangleType::negative_joined;
        if (random_.below(10)) continue;
        if (type == TriangleType::positive) type = TriangleType::positive_grown;
        if (type == TriangleType::negative) type = TriangleType::negative_grown;
      }
      mark(types);
      found += search(rule.closure());
    }
    return found;
  }

 private:
  SearchMeshes& random_;
  const MovingMesh& mesh_;
  BoundingVolumeTree tree_;
  SearchMemory memory_;
  FeaturePairs pairs_;
  BruteForce brute_force_;
  std::set<FeatureKey> keys_;
};

TEST(FeaturePairs, L7_AreThoseOfAllCandidatesEachOnce) {
  SearchMeshes random(11);
  std::size_t found = 0;
  for (int round = 0; round < 40; ++round) {
    const MovingMesh mesh = random.sheets(1 + round % 3, 2 + round % 4, round % 2 == 1);
    Sequence sequence(random, mesh);
    std::vector<TriangleType> types(mesh.topology.triangles.size(), TriangleType::positive);
    for (int step = 0; step < 4; ++step) {
      random.change(types, 1 + random.below(12));
      found += sequence.step(PairRule(), types);
    }
  }
  EXPECT_GT(found, 10000u);
}

TEST(FeaturePairs, OfEveryPairEachOnce) {
  SearchMeshes random(12);
  std::size_t found = 0;
  for (int round = 0; round < 10; ++round) {
    const MovingMesh mesh = random.sheets(1 + round % 3, 5, round % 2 == 1);
    Sequence sequence(random, mesh);
    const std::vector<TriangleType> all_dirty(mesh.topology.triangles.size(), TriangleType::dirty);
    sequence.mark(all_dirty);
    found += sequence.search(EveryPair().candidates());
  }
  EXPECT_GT(found, 1000u);
}

// What diagonals tell apart is strictly ordered along one of them in exact arithmetic.

constexpr std::array<std::array<int, 3>, 4> directions = {
    {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}};

Rational along(const std::array<int, 3>& d, const Positions& x, std::int32_t v) {
  return d[0] * Rational(x(v, 0)) + d[1] * Rational(x(v, 1)) + d[2] * Rational(x(v, 2));
}

// In one sense at both ends, along some diagonal.
bool ordered(const Positions& x_t0, const Positions& x_t1, std::int32_t a, std::int32_t b) {
  for (const auto& d : directions) {
    const Rational t0 = along(d, x_t0, a) - along(d, x_t0, b);
    const Rational t1 = along(d, x_t1, a) - along(d, x_t1, b);
    if ((t0 < 0 && t1 < 0) || (t0 > 0 && t1 > 0)) return true;
  }
  return false;
}

// With this margin axes, or diagonals, tell nothing apart.
constexpr float beyond_all = std::numeric_limits<float>::infinity();
constexpr FloatLanes beyond_all_lanes = {beyond_all, beyond_all, beyond_all, beyond_all};

TEST(FeatureBoxes, L3_ApartAlongDiagonalsIsOrderedExactly) {
  constexpr double largest = std::numeric_limits<double>::max();
  std::mt19937_64 engine(3);
  const auto below = [&](std::uint64_t n) { return static_cast<double>(engine() % n); };
  FeatureMargin of_diagonals;
  of_diagonals.axes = beyond_all_lanes;
  std::size_t told_apart = 0, close = 0;
  for (int round = 0; round < tests::usual(30000); ++round) {
    const int family = round % 6;
    Positions x[2] = {Positions(4, 3), Positions(4, 3)};
    for (auto& frame : x) {
      for (Eigen::Index i = 0; i < 12; ++i) {
        double& c = frame.data()[i];
        if (family == 0) c = below(3) - 1;
        if (family == 1) c = below(1 << 20) * 0x1p-19 - 1;
        // Sums that differ by about the margin, near the middle and at the border.
        if (family == 2) c = (below(3) - 1) + (below(9) - 4) * 0x1p-21;
        if (family == 3) c = 1e9 + below(3) + (below(9) - 4) * 0x1p-20;
        if (family == 4) c = (below(5) - 2) * (largest / 2);
        if (family == 5) c = below(5) * std::numeric_limits<double>::denorm_min();
      }
    }
    const FeaturePoints points({x[0], x[1]});
    const bool is_apart = are_apart(points, {0, 0}, {1, 1}, of_diagonals);
    const bool is_ordered = ordered(x[0], x[1], 0, 1);
    EXPECT_TRUE(!is_apart || is_ordered);
    told_apart += is_apart;
    close += is_ordered && !is_apart;
  }
  EXPECT_GT(told_apart, tests::usual(5000));
  EXPECT_GT(close, tests::usual(100));
}

// A vertex touches the middle of an edge of a face; all lie in one plane x + y + z = s. Doubles
// round their sums to s or to a neighbour of s, and the middle of two floats lies between these.
// So the vertex may be rounded to the float above and the face to the float below. The margin
// keeps them together.
TEST(FeatureBoxes, L3_WhatTouchesBetweenTwoFloatsIsFound) {
  constexpr double s = 1 + 0x1p-24 + 0x1p-52;
  std::mt19937_64 engine(4);
  const auto between = [&](double lo, double hi) {
    const auto steps = static_cast<std::uint64_t>((hi - lo) * 0x1p53);
    return lo + static_cast<double>(engine() % steps) * 0x1p-53;
  };
  const auto in_plane = [](double y0, double y1) { return Point{y0, y1, s - y0 - y1}; };
  // The first vertex touches the face 3, 4, 5. The others hold the middle of all positions at 0.
  const Triangles mesh = triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
  const Positions around =
      positions_of("-4 -4 -4, -4 -3.5 -4, -3.5 -4 -4, 4 4 4, 4 3.5 4, 3.5 4 4");
  for (int round = 0; round < 2000; ++round) {
    const double p0 = between(.6, .8), p1 = between(.6, .8), d0 = between(0, .1),
                 d1 = between(0, .1);
    const Point p = in_plane(p0, p1), c = in_plane(between(.8, 1), between(.8, 1));
    const Point q = {p[0] + .5, p[1] + .25, p[2] + .25}, r = {p[0] + .25, p[1] + .5, p[2] + .25};
    Positions x(12, 3);
    x << positions({p, q, r, in_plane(p0 + d0, p1 + d1), in_plane(p0 - d0, p1 - d1), c}), around;
    auto detector = std::move(Detector::create(mesh, x, {Culling::bvh}).value());
    ASSERT_EQ(detector.evaluate(x, x).answer, Answer::collision) << round;
  }
}

// Neither the axes nor a diagonal tells these apart; one of each alone does.
TEST(FeatureBoxes, AxesAndDiagonals) {
  const Positions x = positions({{0, 0, 0}, {1, -1, 0}, {.9, .9, 0}, {1.5, -.5, .1}});
  const FeaturePoints points({x, x});
  FeatureMargin of_axes;
  of_axes.diagonals = beyond_all_lanes;
  EXPECT_FALSE(are_apart(points, {0, 1}, {2, 3}, of_axes));
  EXPECT_TRUE(are_apart(points, {0, 1}, {2, 3}, {}));
  EXPECT_FALSE(are_apart(points, {0, 1}, {0, 1}, {}));
}

// The places at a time, against exact arithmetic: they are off by less than the slack allows.

TEST(ShortenedStep, PlacesAreOffByAQuarterOfTheSlackAtMost) {
  std::mt19937_64 engine(41);
  const auto full = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1; };
  for (const int exponent : {0, 1023, -1060, 40}) {
    Positions x_t0(50, 3), x_t1(50, 3);
    for (Eigen::Index i = 0; i < x_t0.size(); ++i) {
      const double far = i % 5 == 0 ? std::ldexp(1., -40) : 1;
      x_t0.data()[i] = std::ldexp(full(), exponent) * far;
      x_t1.data()[i] = std::ldexp(full(), exponent);
    }
    for (const double until : {.5, 1. / 3, 1e-9, 0x1p-1074, std::nextafter(1., 0.)}) {
      PacedStop pace(never_stops);
      const ShortenedStep shortened({x_t0, x_t1}, until, pace);
      const Rational allowed = Rational(shortened.slack()) / 4;
      ASSERT_GT(shortened.slack(), 0);
      EXPECT_LE(shortened.slack(), std::ldexp(1., exponent - 47) + 0x1p-1069);
      for (Eigen::Index v = 0; v < 50; ++v) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          const Rational exact = Rational(x_t0(v, k)) +
                                 Rational(until) * (Rational(x_t1(v, k)) - Rational(x_t0(v, k)));
          const Rational off = Rational(shortened.motion().vertices_t1(v, k)) - exact;
          EXPECT_LE(off, allowed);
          EXPECT_GE(off, -allowed);
          EXPECT_EQ(shortened.motion().vertices_t0(v, k), x_t0(v, k));
        }
      }
    }
  }
}

TEST(ShortenedStep, AtTheStartItIsExact) {
  const Positions x_t0 = Positions::Constant(2, 3, .1), x_t1 = Positions::Constant(2, 3, 7);
  PacedStop pace(never_stops);
  const ShortenedStep shortened({x_t0, x_t1}, 0, pace);
  EXPECT_EQ(shortened.slack(), 0);
  EXPECT_EQ(shortened.motion().vertices_t1, x_t0);
}

// Two vertices on a line, one of which has caught up with the other at the bound, by less than the
// places there are rounded. Some places then lie in the old order, and only the slack keeps the
// boxes from being apart.
TEST(ShortenedStep, WhatMeetsByTheBoundIsNotApart) {
  std::mt19937_64 engine(43);
  const auto full = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -53); };
  constexpr double until = .9;
  const auto exactly = [&](const Positions& x_t0, const Positions& x_t1,
                           Eigen::Index v) -> Rational {
    return Rational(x_t0(v, 0)) + Rational(until) * (Rational(x_t1(v, 0)) - Rational(x_t0(v, 0)));
  };
  int in_old_order = 0;
  for (int i = 0; i < 1'000; ++i) {
    Positions x_t0 = Positions::Zero(2, 3), x_t1 = Positions::Zero(2, 3);
    x_t0(0, 0) = full();
    x_t1(0, 0) = 1 + full();
    x_t0(1, 0) = x_t0(0, 0) + 8 * full();
    const double there = place_between(x_t0(0, 0), x_t1(0, 0), until);
    x_t1(1, 0) = (there - (1 - until) * x_t0(1, 0)) / until;
    while (exactly(x_t0, x_t1, 1) > exactly(x_t0, x_t1, 0))
      x_t1(1, 0) = std::nextafter(x_t1(1, 0), -10.);
    PacedStop pace(never_stops);
    const ShortenedStep shortened({x_t0, x_t1}, until, pace);
    const auto& end = shortened.motion().vertices_t1;
    in_old_order += end(0, 0) < end(1, 0);
    const FeaturePoints points(shortened.motion(), nullptr, shortened.slack());
    EXPECT_FALSE(are_apart(points, {0, 0}, {1, 1}, points.margin()));
  }
  EXPECT_GT(in_old_order, 10);
}

TEST(SearchRounds, EachNumberComesOnce) {
  for (std::size_t count : {0u, 1u, 2u, 3u, 37u, 64u, 511u, 512u, 600u}) {
    auto numbers = spread_numbers(count);
    ASSERT_EQ(numbers.size(), count);
    std::sort(numbers.begin(), numbers.end());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(numbers[i], i);
  }
  const auto numbers = spread_numbers(512);
  EXPECT_EQ(numbers[1], 256u);
  EXPECT_EQ(numbers[3], 384u);
}

}  // namespace
}  // namespace assay::tests
