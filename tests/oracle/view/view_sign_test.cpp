// Exact view signs. L1 and L2 are the laws of view points and view lines.
#include "oracle/view/view_sign.h"

#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::MovingPoint, detector::Point, detector::ViewPrimitive, detector::ViewSign,
    test::Random, test::rest;

ViewPrimitive view_point(const Point& q) { return {rest(q), rest(q)}; }
ViewPrimitive view_line(const Point& q0, const Point& q1) { return {rest(q0), rest(q1)}; }

// Both rungs, where the first decides, and the public function.
ViewSign sign_of(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  const ViewSign exact = exact_view_sign(triangle, primitive);
  EXPECT_EQ(interval_view_sign(triangle, primitive).value_or(exact), exact);
  EXPECT_EQ(view_sign(triangle, primitive), exact);
  return exact;
}

MovingTriangle at_height(double z_t0, double z_t1) {
  auto corner = [&](double x, double y) { return MovingPoint{{x, y, z_t0}, {x, y, z_t1}}; };
  return {corner(-4, -4), corner(4, -4), corner(0, 4)};
}

MovingTriangle turned(const MovingTriangle& t) { return {t[0], t[2], t[1]}; }

TEST(ViewPointSign, AboveAndBelow) {
  EXPECT_EQ(sign_of(at_height(1, 2), view_point({0, 0, 0})), ViewSign::positive);
  EXPECT_EQ(sign_of(turned(at_height(1, 2)), view_point({0, 0, 0})), ViewSign::negative);
  EXPECT_EQ(sign_of(at_height(-1, -2), view_point({0, 0, 0})), ViewSign::negative);
}

TEST(ViewPointSign, PassingAndTouchingAreZero) {
  for (const auto& [from, to] : {std::pair{1, -2}, {1, 0}, {0, 1}, {0, 0}})
    EXPECT_EQ(sign_of(at_height(from, to), view_point({0, 0, 0})), ViewSign::zero) << from << to;
}

TEST(ViewPointSign, CornerCrossesTheOppositeEdge) {
  // f = k (t - 1/2)^2: positive before and after, zero at 1/2.
  const MovingTriangle t = {MovingPoint{{2, 0, 0.5}, {2, 0, -0.5}}, rest({0, 2, 0}),
                            MovingPoint{{0.75, 1, 0.25}, {1.25, 1, -0.25}}};
  EXPECT_EQ(sign_of(t, view_point({0, 0, 0})), ViewSign::zero);
}

TEST(ViewPointSign, ZeroAreaIsZero) {
  EXPECT_EQ(sign_of({rest({1, 0, 0}), rest({2, 0, 0}), rest({3, 0, 0})}, view_point({0, 5, 0})),
            ViewSign::zero);
  // At one time only.
  EXPECT_EQ(sign_of({rest({0, 0, 1}), rest({2, 0, 1}), MovingPoint{{1, 1, 1}, {1, -1, 1}}},
                    view_point({0, 0, 0})),
            ViewSign::zero);
}

TEST(ViewPointSign, MovingPoint) {
  ViewPrimitive q;
  q.q0 = q.q1 = {{0, 0, 0}, {0, 0, 5}};
  EXPECT_EQ(sign_of(at_height(1, 6), q), ViewSign::positive);
  EXPECT_EQ(sign_of(at_height(1, 4), q), ViewSign::zero);
}

TEST(ViewLineSign, L1_EachVertexHasItsOwnNearestPoint) {
  const MovingTriangle t = {rest({.4, 1, .1}), rest({-.4, 1, .9}), rest({0, 5, .5})};
  EXPECT_EQ(sign_of(t, view_line({0, 0, 0}, {0, 0, 1})), ViewSign::zero);
}

TEST(ViewLineSign, FixedLine) {
  EXPECT_EQ(sign_of(at_height(1, 2), view_line({-1, 0, 0}, {1, 0, 0})), ViewSign::positive);
  EXPECT_EQ(sign_of(at_height(1, 2), view_line({0, 0, 3}, {1, 0, 4})), ViewSign::negative);
  // One end above, one below the triangle: vertices beside the middle see both.
  EXPECT_EQ(sign_of(at_height(1, 1), view_line({0, 0, 0}, {0, 0, 2})), ViewSign::zero);
}

TEST(ViewLineSign, OnlyTheMiddlePieceDecides) {
  // The plane of the triangle meets the line beyond what its vertices are nearest to: the two ends
  // are on different sides, yet every vertex is nearest to inner points on one side.
  const ViewPrimitive line = view_line({0, 0, -10}, {0, 0, 10});
  const MovingTriangle t = {rest({1, -1, -5}), rest({1, 1, -5}), rest({2, 0, -4.25})};
  const ViewSign sign = sign_of(t, line);
  EXPECT_NE(sign, ViewSign::zero);
  EXPECT_EQ(sign_of(turned(t), line),
            sign == ViewSign::positive ? ViewSign::negative : ViewSign::positive);
  EXPECT_EQ(sign_of(t, {line.q1, line.q0}), sign);
}

TEST(ViewLineSign, TranslatingLine) {
  const ViewPrimitive line = {{{-1, 0, 0}, {-1, 0, 5}}, {{1, 0, 0}, {1, 0, 5}}};
  EXPECT_EQ(sign_of(at_height(1, 6), line), ViewSign::positive);
  EXPECT_EQ(sign_of(at_height(1, 2), line), ViewSign::zero);
}

TEST(ViewLineSign, L2_EndsMoveApart) {
  // A point that becomes a segment under the triangle.
  const ViewPrimitive line = {{{0, 0, 0}, {-3, 0, 0}}, {{0, 0, 0}, {3, 0, 0.5}}};
  EXPECT_EQ(sign_of(at_height(1, 1), line), ViewSign::positive);
  EXPECT_EQ(sign_of(at_height(1, 0.25), line), ViewSign::zero);
  // A segment that shrinks to a point and turns round.
  const ViewPrimitive through = {{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
  EXPECT_EQ(sign_of(at_height(1, 1), through), ViewSign::positive);
  EXPECT_EQ(sign_of(at_height(1, 0), through), ViewSign::zero);
}

TEST(ViewLineSign, IdenticallyZeroPolynomials) {
  // The end q0 stays in the plane of the triangle (h0 = 0), but no vertex is nearest to it.
  const MovingTriangle t = {rest({1, 0, 0}), rest({1, 1, 0.5}), rest({1, -1, 0.5})};
  EXPECT_NE(sign_of(t, view_line({1, 0, -9}, {0, 0, 9})), ViewSign::zero);
  // A vertex at the end itself.
  EXPECT_EQ(sign_of(t, view_line({1, 0, 0}, {0, 0, 9})), ViewSign::zero);
  // The whole line in the plane: hm = 0 as well.
  EXPECT_EQ(sign_of(t, view_line({1, 5, 0}, {1, 6, 1})), ViewSign::zero);
}

TEST(ViewSigns, RungsAgreeAndSymmetriesHold) {
  Random random(42);
  for (int i = 0; i < tests::usual(1500); ++i) {
    const auto kind = static_cast<test::Coordinates>(i % test::coordinate_kinds);
    MovingTriangle t;
    for (MovingPoint& p : t) p = test::random_point(random, kind);
    ViewPrimitive q = {test::random_point(random, kind), test::random_point(random, kind)};
    if (i % 3 == 0) {
      for (MovingPoint& p : t) p.t1 = p.t0;
    }
    if (i % 4 == 0) q = {rest(q.q0.t0), rest(q.q1.t0)};
    if (i % 5 == 0) q.q1 = q.q0;
    const ViewSign exact = exact_view_sign(t, q);
    ASSERT_EQ(interval_view_sign(t, q).value_or(exact), exact) << i;
    ASSERT_EQ(exact_view_sign({t[1], t[2], t[0]}, q), exact) << i;
    ASSERT_EQ(exact_view_sign(t, {q.q1, q.q0}), exact) << i;
    ASSERT_EQ(static_cast<int>(exact_view_sign(turned(t), q)), -static_cast<int>(exact)) << i;
    for (MovingPoint* p : {&t[0], &t[1], &t[2], &q.q0, &q.q1}) std::swap(p->t0, p->t1);
    ASSERT_EQ(exact_view_sign(t, q), exact) << i;
  }
}

TEST(ViewSigns, ExtremeNumbers) {
  for (const double scale : {0x1p-1060, 0x1p-500, 0x1p500, 0x1p1015}) {
    auto scaled = [&](MovingTriangle t) {
      for (MovingPoint& p : t) {
        for (int k = 0; k < 3; ++k) {
          p.t0[k] *= scale;
          p.t1[k] *= scale;
        }
      }
      return t;
    };
    const ViewPrimitive line = view_line({-scale, 0, 0}, {scale, 0, 0});
    EXPECT_EQ(sign_of(scaled(at_height(1, 2)), line), ViewSign::positive);
    EXPECT_EQ(sign_of(scaled(at_height(1, -1)), line), ViewSign::zero);
    EXPECT_EQ(sign_of(scaled(at_height(1, 0)), line), ViewSign::zero);
  }
  EXPECT_EQ(sign_of(at_height(5e-324, 1), view_point({0, 0, 0})), ViewSign::positive);
  EXPECT_EQ(sign_of(at_height(5e-324, 0), view_point({0, 0, 0})), ViewSign::zero);
}

std::vector<int> signs_of(const test::Step& step, const ViewPrimitive& primitive) {
  std::vector<int> result;
  for (const ViewSign s : view_signs({step.x_t0, step.x_t1}, step.f, std::span(&primitive, 1))) {
    result.push_back(static_cast<int>(s));
  }
  return result;
}

TEST(ViewSigns, Meshes) {
  const ViewPrimitive origin = view_point({0, 0, 0});
  EXPECT_EQ(signs_of(test::turning_tetrahedron(), origin), (std::vector{0, 0, 0, 0}));
  EXPECT_EQ(signs_of(test::collapsing_octahedron(), origin), (std::vector{0, 1, 1, 0, 1, 0, 0, 1}));
  EXPECT_EQ(signs_of(test::intersecting_octahedron(), origin),
            (std::vector{1, 1, 1, -1, 1, 1, 1, -1}));
  EXPECT_EQ(signs_of(test::seven_vertices_about_a_line(), view_line({0, 0, -1}, {0, 0, 1})),
            (std::vector{1, 1, 1, 0, 1, 1, 1, 1, 1, 1}));
}

TEST(ViewSigns, OnePrimitiveForEachTriangle) {
  const test::Step step = test::intersecting_octahedron();
  std::vector<ViewPrimitive> primitives(8, view_point({0, 0, 0}));
  primitives[0] = view_point({100, -100, 100});
  const auto signs = view_signs({step.x_t0, step.x_t1}, step.f, primitives);
  EXPECT_NE(signs[0], ViewSign::positive);
  EXPECT_EQ(signs[1], ViewSign::positive);
  EXPECT_EQ(signs[3], ViewSign::negative);
}

// Which pairs signs leave to be tested.

constexpr ViewSign P = ViewSign::positive, M = ViewSign::negative, Z = ViewSign::zero;

TEST(Candidates, BySigns) {
  const Candidates k({P, P, M, M, Z, Z}, {});
  EXPECT_TRUE(k.holds({0, 2}));   // (V+,V-)
  EXPECT_FALSE(k.holds({0, 1}));  // (V+,V+)
  EXPECT_FALSE(k.holds({2, 3}));  // (V-,V-)
  EXPECT_TRUE(k.holds({0, 4}));   // (U,V0)
  EXPECT_TRUE(k.holds({2, 4}));
  EXPECT_TRUE(k.holds({4, 5}));  // V0 is in U
}

TEST(Candidates, ViolatedMeetAll) {
  const Candidates k({P, P, P, P}, {0, 1, 1, 0});
  EXPECT_TRUE(k.holds({0, 1}));
  EXPECT_TRUE(k.holds({1, 2}));  // Vv is in U
  EXPECT_FALSE(k.holds({0, 3}));
}

TEST(Candidates, L10_PairsOfTwoGroups) {
  const Candidates k({P, P, P}, {}, {0, 0, 1});
  EXPECT_FALSE(k.holds({0, 1}));
  EXPECT_TRUE(k.holds({1, 2}));
}

TEST(Candidates, FirstContacts) {
  const std::vector<detector::PairContact> pairs = {
      {{0, 1}, {0.25, 0.25}, {}}, {{0, 2}, {0.5, 0.5}, {}}, {{1, 2}, {0.25, 0.25}, {}}};
  const Candidates k({P, P, M}, {});
  EXPECT_FALSE(k.holds(pairs[0].pair));
  EXPECT_TRUE(k.holds(pairs[1].pair));
  EXPECT_TRUE(k.holds(pairs[2].pair));
  EXPECT_TRUE(holds_a_first_contact(pairs, k));
  EXPECT_FALSE(holds_a_first_contact({pairs[0], pairs[1]}, k));
  EXPECT_TRUE(holds_a_first_contact({}, k));
}

}  // namespace
}  // namespace assay::oracle
