// If fans are proved apart, no two of their triangles are in contact, by exact arithmetic.
#include "detector/search/vertex_fans.h"

#include "detector/boundary/ghost_sweep.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using namespace detector;

// The fans around vertex 0, each of so many triangles, and two triangles elsewhere that say how
// large the mesh is.
Triangles fans(std::span<const int> sizes) {
  std::vector<std::array<std::int32_t, 3>> rows;
  std::int32_t first = 1;
  for (const int size : sizes) {
    for (int i = 0; i < size; ++i) rows.push_back({0, first + i, first + (i + 1) % size});
    first += size;
  }
  rows.push_back({first, first + 1, first + 2});
  rows.push_back({first + 3, first + 4, first + 5});
  return triangles(rows);
}

class FanMesh {
 public:
  FanMesh(SearchMeshes& random, std::span<const int> sizes)
      : random_(random),
        rows_(fans(sizes)),
        mesh_(make_topology(rows_, rows_.maxCoeff() + 1)),
        x_t0_(rows_.maxCoeff() + 1, 3),
        x_t1_(x_t0_) {}

  // Rings around vertex 0 in turns of `turns` each, seen along an axis, that rise and fall by as
  // much as `waves`, at both ends of the step; each end is drawn anew by the share `jitter`.
  void place(std::span<const int> sizes, int turns, double waves, double jitter, double scale,
             int axis) {
    const double side = random_.below(2) == 0 ? 1 : -1;  // seen from above, or from below
    const auto frame = [&](Positions& x) {
      const double turn = 2 * 3.14159265358979 * random_.number(false);
      Eigen::Index v = 1;
      put(x, 0, {0, 0, 0}, scale, axis);
      for (const int size : sizes) {
        for (int i = 0; i < size; ++i) {
          const double angle =
              turn + 2 * 3.14159265358979 * turns * (i + .4 * random_.number(false)) / size;
          const double r = 1 + .5 * random_.number(false);
          put(x, v++,
              {side * r * std::cos(angle), r * std::sin(angle), waves * random_.number(false)},
              scale, axis);
        }
      }
    };
    frame(x_t0_);
    frame(x_t1_);
    x_t1_ = x_t0_ + jitter * (x_t1_ - x_t0_);
    far_away();
  }

  // All coordinates of few values: edges in line, triangles without area, what is twice there.
  void place_coarsely(bool moves) {
    for (Eigen::Index i = 0; i < x_t0_.size(); ++i) {
      x_t0_.data()[i] = random_.number(true);
      x_t1_.data()[i] = moves ? random_.number(true) : x_t0_.data()[i];
    }
    far_away();
  }

  bool is_proved() const {
    VertexFans fans;
    fans.prove(mesh_, FeaturePoints(motion()), nullptr);
    return fans.are_apart(0, 1);
  }
  // Whether two triangles of the fan are in contact, by all of their features.
  bool meets_itself() const {
    const auto exact = make_elementary_test(Arithmetic::exact);
    const FacePairTest faces(motion(), *exact, true);
    GhostCounts counts;
    const std::size_t count = mesh_.triangles.size() - 2;
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        if (faces.meet(mesh_.triangles[a], mesh_.triangles[b], counts)) return true;
      }
    }
    return false;
  }

 private:
  SteppedMesh motion() const { return {x_t0_, x_t1_}; }
  static void put(Positions& x, Eigen::Index v, const Point& p, double scale, int axis) {
    for (Eigen::Index k = 0; k < 3; ++k)
      x(v, (k + axis) % 3) = scale * p[static_cast<std::size_t>(k)];
  }
  void far_away() {
    for (auto* x : {&x_t0_, &x_t1_}) {
      for (Eigen::Index i = 0; i < 6; ++i)
        x->row(x->rows() - 1 - i) << (i < 3 ? 2.5 : -2.5), i % 3 == 1, i % 3 == 2;
    }
  }

  SearchMeshes& random_;
  const Triangles rows_;
  const Topology mesh_;
  Positions x_t0_, x_t1_;
};

// By family: how many were proved, and how many are in no contact.
struct Tally {
  int proved = 0, apart = 0, drawn = 0;
  void add(const FanMesh& mesh) {
    const bool is_proved = mesh.is_proved(), meets = mesh.meets_itself();
    EXPECT_FALSE(is_proved && meets) << drawn;
    proved += is_proved;
    apart += !meets;
    ++drawn;
  }
};

TEST(VertexFans, L13_WhatIsProvedIsInNoContact) {
  SearchMeshes random(17);
  constexpr int draws = 400;
  for (const double jitter : {0., .2, 1.}) {
    for (const double waves : {0., .3, 3.}) {
      Tally tally;
      for (int i = 0; i < draws; ++i) {
        const int sizes[] = {3 + random.below(6)};
        FanMesh mesh(random, sizes);
        mesh.place(sizes, 1, waves, jitter, 1, i % 3);
        tally.add(mesh);
      }
      // Angles may be of more than half a turn: of some fans no triangle is seen as it turns.
      EXPECT_TRUE(jitter > 0 || tally.proved > tally.apart - draws / 20) << waves;
      EXPECT_TRUE(jitter == 1 || tally.proved > draws / 10) << jitter << " " << waves;
    }
  }
}

// Around more than once, in one ring or in two of one turn each: every triangle is seen from above.
TEST(VertexFans, L13_WhatLiesTwiceAroundIsNotProved) {
  SearchMeshes random(18);
  for (int i = 0; i < 200; ++i) {
    const int one[] = {7 + random.below(6)}, two[] = {3 + random.below(4), 3 + random.below(4)};
    FanMesh twice(random, one), both(random, two);
    twice.place(one, 2, .3, 0, 1, i % 3);
    both.place(two, 1, .3, 0, 1, i % 3);
    EXPECT_FALSE(twice.is_proved());
    EXPECT_FALSE(both.is_proved());
  }
}

// So small beside the mesh that its floats can just tell which way a triangle turns, or cannot.
TEST(VertexFans, L13_AsSmallAsTheFloatsOfTheMesh) {
  SearchMeshes random(19);
  int proved = 0, open = 0;
  for (int bits = 10; bits < 26; ++bits) {
    Tally tally;
    for (int i = 0; i < 300; ++i) {
      const int sizes[] = {3 + random.below(6)};
      FanMesh mesh(random, sizes);
      mesh.place(sizes, 1, i % 2 ? .3 : 3, i % 5 ? 0 : .3, std::ldexp(1., -bits), i % 3);
      tally.add(mesh);
    }
    proved += tally.proved;
    open += tally.apart - tally.proved;
  }
  EXPECT_GT(proved, 500);
  EXPECT_GT(open, 500);
}

TEST(VertexFans, L13_OfCoarseCoordinates) {
  SearchMeshes random(20);
  Tally tally;
  for (int i = 0; i < 40'000; ++i) {
    const int sizes[] = {3 + random.below(4)};
    FanMesh mesh(random, sizes);
    mesh.place_coarsely(i % 4 == 0);
    tally.add(mesh);
  }
  EXPECT_GT(tally.proved, 20);
  EXPECT_GT(tally.apart, tally.proved);
}

// Half around, and back upside down: at both ends of the step the fan is seen from above.
TEST(VertexFans, L13_WhatTurnsOverOnTheWayIsNotProved) {
  const Topology mesh = make_topology(triangles({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}), 5);
  const Positions x = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  const auto proves = [&](const Positions& end) {
    VertexFans fans;
    fans.prove(mesh, FeaturePoints({x, end}), nullptr);
    return fans.are_apart(0, 1);
  };
  EXPECT_TRUE(proves(x));
  EXPECT_FALSE(proves(-x));
}

// A vertex at the edge of a sheet has no fan around it, and its pairs are looked at.
TEST(VertexFans, L13_OfAnOpenSheetTheInnerVerticesAreProved) {
  const Topology mesh = make_topology(squares(4, 4), 25);
  const Positions x = flat_squares(4);
  VertexFans fans;
  EXPECT_FALSE(fans.are_apart(0, 1)) << "before they are looked at";
  fans.prove(mesh, FeaturePoints({x, x}), nullptr);
  const auto count = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t a = 0; a < count; ++a) {
    for (std::int32_t b = 0; b < a; ++b) {
      const auto &p = mesh.triangles[at(a)], &q = mesh.triangles[at(b)];
      const bool shares_inner = std::any_of(p.begin(), p.end(), [&](std::int32_t v) {
        return v % 5 > 0 && v % 5 < 4 && v / 5 > 0 && v / 5 < 4 &&
               std::find(q.begin(), q.end(), v) != q.end();
      });
      EXPECT_EQ(fans.are_apart(a, b), shares_inner);
    }
  }
}

// Points of a stopped pace are not there.
TEST(VertexFans, NothingIsProvedOnceItIsStopped) {
  const Topology mesh = make_topology(squares(40, 40), 1681);
  const Positions x = flat_squares(40);
  for (const std::uint32_t threads : {1, 3}) {
    const Workers workers(threads);
    const StopFunction at_once = [] { return true; };
    PacedStop pace(at_once, workers);
    EXPECT_TRUE(pace.now());
    VertexFans fans;
    fans.prove(mesh, FeaturePoints({x, x}, &pace), &pace);
    EXPECT_FALSE(fans.are_apart(0, 1));
  }
}

}  // namespace
}  // namespace assay::tests
