// The promises of the arithmetics without integers, stage by stage, compared with exact arithmetic.
// Arithmetic::bounded leaves a question open rather than answer it wrongly; `double` and `float`
// are wrong where that is known.
#include "detector/boundary/ghost_sweep.h"
#include "detector/boxes/moving_box.h"
#include "detector/contact/rungs.h"
#include "detector/detector.h"
#include "detector/exact/real_root.h"
#include "detector/geometry/orientation.h"
#include "detector/geometry/winding.h"
#include "detector/view/view_signs.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::still;

class Draw {
 public:
  int between(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  // Small integers, one in four a neighbouring double, so that near-degenerate places are frequent.
  Point point(int reach) {
    Point p;
    for (double& c : p) {
      c = between(-reach, reach);
      if (between(0, 3) == 0) c = std::nextafter(c, between(0, 1) ? 10.0 : -10.0);
    }
    return p;
  }

 private:
  std::mt19937_64 engine_{20112};
};

// Coefficients are small integers, so that the polynomial is known exactly; each is then off by at
// most the bound that is stated.
TEST(Arithmetic, FirstRootIsEnclosed) {
  Draw draw;
  int cubics = 0, narrow = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<int, 4> b;
    for (int& c : b) c = draw.between(-9, 9);
    if (b[0] * b[3] >= 0) continue;
    const auto of = [](int value) { return Polynomial::constant(Integer(value)); };
    const Polynomial t = Polynomial::linear(Integer(0), Integer(1));
    const Polynomial f =
        of(b[0]) + t * (of(3 * (b[1] - b[0])) + t * (of(3 * (b[2] - 2 * b[1] + b[0])) +
                                                     t * of(b[3] - 3 * b[2] + 3 * b[1] - b[0])));
    const auto first = roots_in_unit_interval(f).front().enclosure();
    const double most = .4 * std::min(std::abs(b[0]), std::abs(b[3]));  // the ends stay beyond it
    for (const double bound : {0.0, 0x1p-40, 0x1p-20, .1 * most, most}) {
      const double all = draw.between(-1, 1);  // by as much, where it is not 0
      Cubic off;
      for (std::size_t k = 0; k < 4; ++k) off[k] = b[k] + bound * (all != 0 ? all : draw.unit());
      const auto found = enclose_first_root(off, bound, 0, 1);
      ASSERT_LE(found.lo, first.lo) << "cubic " << i << ", bound " << bound;
      ASSERT_GE(found.hi, first.hi) << "cubic " << i << ", bound " << bound;
      narrow += bound == 0 && found.hi - found.lo < 1e-13 ? 1 : 0;
    }
    ++cubics;
  }
  EXPECT_GT(cubics, 5000);
  EXPECT_GT(narrow, cubics * 9 / 10);
}

TEST(Arithmetic, BoundedPiercingIsNeverWrong) {
  Draw draw;
  int open = 0, yes = 0;
  constexpr int cases = 50000;
  for (int i = 0; i < cases; ++i) {
    const Point e0 = draw.point(3), e1 = draw.point(3);
    const std::array<Point, 3> face = {draw.point(3), draw.point(3), draw.point(3)};
    const bool exact = segment_pierces_triangle(e0, e1, face);
    const auto bounded = bounded_piercing(e0, e1, face);
    open += bounded == Decision::open;
    ASSERT_TRUE(bounded == Decision::open || (bounded == Decision::yes) == exact) << i;
    yes += exact;
  }
  EXPECT_GT(yes, cases / 50);
  EXPECT_GT(open, 0);
  EXPECT_LT(open, cases / 10);
  // Triangles in one plane.
  const std::array<Point, 3> face = {Point{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  EXPECT_EQ(bounded_piercing({.7, .6, 1}, {.6, .7, 1}, face), Decision::no);
  EXPECT_EQ(bounded_piercing({.1, .1, 1}, {.2, .2, 1}, face), Decision::open);
}

TEST(Arithmetic, BoundedWindingNumbersAreRightOrAbsent) {
  Draw draw;
  const Topology mesh = make_topology(octahedron(), 6);
  const auto& all = mesh.components[0].triangles;
  int absent = 0, present = 0;
  for (int i = 0; i < 3000; ++i) {
    Positions x = octahedron_positions(3);
    for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] += draw.between(-2, 2);
    const Point point = draw.point(3);
    const auto exact = winding_number(mesh, all, x, point);
    const auto bounded = winding_number(mesh, all, x, point, Arithmetic::bounded);
    ASSERT_EQ(bounded ? bounded : exact, exact) << i;
    ++(bounded ? present : absent);
    const auto outside = winding_numbers_outside(mesh, all, x, all, Arithmetic::bounded);
    const auto exact_outside = winding_numbers_outside(mesh, all, x, all);
    for (std::size_t t = 0; t < 8; ++t)
      ASSERT_TRUE(!outside[t] || outside[t] == exact_outside[t]) << i << ", triangle " << t;
  }
  EXPECT_GT(present, 5 * absent);
}

TEST(Arithmetic, BoundedViewSignsAreRightOrZero) {
  Draw draw;
  const ViewClassifier bounded_classifier(Arithmetic::bounded), exact_classifier;
  const Topology mesh = make_topology(octahedron(), 6);
  ViewCounts bounded_counts, exact_counts;
  for (int i = 0; i < 3000; ++i) {
    Positions x_t0 = octahedron_positions(3), x_t1 = x_t0;
    for (auto* x : {&x_t0, &x_t1}) {
      for (Eigen::Index k = 0; k < x->size(); ++k) x->data()[k] += draw.between(-2, 2);
    }
    const MovingPoint q0 = still(draw.point(2)), q1 = i % 2 ? q0 : still(draw.point(2));
    std::vector<ViewSign> bounded(8), exact(8);
    PacedStop pace(never_stops);
    bounded_classifier.classify(mesh, mesh.components[0], {x_t0, x_t1}, {q0, q1}, bounded,
                                bounded_counts, pace);
    exact_classifier.classify(mesh, mesh.components[0], {x_t0, x_t1}, {q0, q1}, exact, exact_counts,
                              pace);
    for (std::size_t t = 0; t < 8; ++t)
      ASSERT_TRUE(bounded[t] == ViewSign::zero || bounded[t] == exact[t])
          << i << ", triangle " << t;
  }
  EXPECT_EQ(bounded_counts.open, exact_counts.exact);
  EXPECT_GT(bounded_counts.open, 0u);
}

// Through the face at t = 0.4.
FourPoints falls_through(double unit) {
  const auto scaled = [unit](Point p) {
    for (double& c : p) c *= unit;
    return p;
  };
  return four_points(
      VertexFace{{scaled({.25, .25, 4}), scaled({.25, .25, -6})},
                 {still(scaled({0, 0, 0})), still(scaled({1, 0, 0})), still(scaled({0, 1, 0}))}});
}

// They exist to be measured: what they get wrong must stay wrong, or measuring them says nothing.
TEST(Arithmetic, DoubleAndFloatAreWrongSomewhere) {
  const auto contact = [](const FourPoints& query, Arithmetic arithmetic) {
    return test_contact(query, Want::yes_no, arithmetic).contact;
  };
  for (const auto arithmetic : all_values<Arithmetic>)
    EXPECT_TRUE(contact(falls_through(1), arithmetic));
  // Products of coordinates underflow: coplanar and collinear all along, as it seems.
  for (const double unit : {0x1p-600, 0x1p-80}) {
    EXPECT_TRUE(contact(falls_through(unit), Arithmetic::exact));
    EXPECT_TRUE(contact(falls_through(unit), Arithmetic::bounded));
  }
  EXPECT_FALSE(contact(falls_through(0x1p-80), Arithmetic::single_precision));
  EXPECT_FALSE(contact(falls_through(0x1p-600), Arithmetic::double_precision));
  EXPECT_TRUE(contact(falls_through(0x1p-80), Arithmetic::double_precision));
  // 2^-30 beside the triangle's edge: float rounds it onto the edge.
  const FourPoints beside =
      four_points(VertexFace{{{.5 + 0x1p-30, .5, 1}, {.5 + 0x1p-30, .5, -1}},
                             {still({0, 0, 0}), still({1, 0, 0}), still({0, 1, 0})}});
  EXPECT_FALSE(contact(beside, Arithmetic::exact));
  EXPECT_FALSE(contact(beside, Arithmetic::bounded));
  EXPECT_TRUE(contact(beside, Arithmetic::single_precision));
  // The triangle turns about an edge; the vertex, at height (3t-1)^2 over its plane, touches it at
  // t = 1/3: a double root is no change of sign.
  const FourPoints touches = four_points(
      VertexFace{{{0, 0, 1}, {1.5, 0, -5}},
                 {still({0, -1, 0}), still({0, 1, 0}), MovingPoint{{1, 0, 0}, {1, 0, -6}}}});
  EXPECT_TRUE(contact(touches, Arithmetic::exact));
  EXPECT_TRUE(contact(touches, Arithmetic::bounded));
  EXPECT_FALSE(contact(touches, Arithmetic::double_precision));
}

// The same detector in each arithmetic, on a step that is free by far and on one that is not.
TEST(Arithmetic, EachAnswersAStep) {
  const Positions x = octahedron_positions(1);
  Positions squeezed = x, through = x;
  squeezed.row(4) *= .5;
  through.row(4) *= -2;
  for (const auto arithmetic : all_values<Arithmetic>) {
    for (const auto culling :
         {Culling::view_point, Culling::view_line, Culling::normal_cone, Culling::bvh}) {
      auto detector =
          Detector::create(octahedron(), x, {culling, Start::verified, Pairs::all, arithmetic});
      EXPECT_EQ(detector.value().evaluate(x, squeezed).answer, Answer::free);
      const auto result = detector.value().evaluate(x, through);
      EXPECT_EQ(result.answer, Answer::collision);
      EXPECT_NEAR(result.first.lo, 2 / 3., 1e-6);
      EXPECT_GE(result.first.hi, 2 / 3. - 1e-6);
    }
  }
}

}  // namespace
}  // namespace assay::detector
