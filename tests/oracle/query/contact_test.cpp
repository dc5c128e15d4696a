// Named queries: their answers, their first times, and the rungs that decide them.
#include "oracle/query/contact.h"

#include <source_location>

#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::EdgeEdge, detector::MovingPoint, detector::Point, detector::TimeEnclosure,
    detector::VertexFace, detector::Want, test::rest;

VertexFace over_resting_face(const Point& from, const Point& to) {
  return {{from, to}, test::resting_face};
}

struct Expected {
  bool contact;
  Rung rung;
  TimeEnclosure first = {};
};

// A failure names the line that expects it.
template <class Query>
void expect(const Query& query, const Expected& expected,
            const std::source_location& at = std::source_location::current()) {
  const testing::ScopedTrace trace(at.file_name(), static_cast<int>(at.line()), "expected here");
  const auto q = four_points(query);
  const ContactAnswer yes_no = contact_of(q, Want::yes_no), timed = contact_of(q, Want::first_time);
  EXPECT_EQ(yes_no.contact, expected.contact);
  EXPECT_EQ(timed.contact, expected.contact);
  EXPECT_EQ(static_cast<int>(yes_no.rung), static_cast<int>(expected.rung));
  EXPECT_EQ(static_cast<int>(timed.rung), static_cast<int>(expected.rung));
  EXPECT_TRUE(!expected.contact || timed.first == expected.first) << timed.first.lo;
}

template <class Query>
void expect_none(const Query& query) {
  for (const Want want : {Want::yes_no, Want::first_time})
    EXPECT_FALSE(contact_of(four_points(query), want).contact);
}

TimeEnclosure at(double t) { return {t, t}; }

// A time that is no double, between t and the next.
TimeEnclosure around(double t) { return {t, std::nextafter(t, 2)}; }

constexpr double below_third = 0x1.5555555555555p-2;

TEST(ContactAxis, SeparatesWhatIsOrderedAtBothEnds) {
  expect(over_resting_face({1, 1, 1}, {1, 1, 0.5}), {false, Rung::axis});
  expect(EdgeEdge{{rest({0, 0, 0}), rest({1, 0, 0})}, {rest({2, 0, 0}), rest({3, 0, 0})}},
         {false, Rung::axis});
  // The order is swapped; and one touches.
  expect(over_resting_face({1, 1, 3}, {1, 1, -1}), {true, Rung::interval, at(0.75)});
  expect(over_resting_face({1, 1, 1}, {1, 1, 0}), {true, Rung::quadratic, at(1)});
}

TEST(ContactInterval, PassesBesideOrCrossesInside) {
  expect(over_resting_face({3, 3, 1}, {3, 3.5, -1}), {false, Rung::interval});
  expect(over_resting_face({1, 1, 1}, {1, 1, -2}), {true, Rung::interval, around(below_third)});
  expect(EdgeEdge{{rest({-1, 0, 0}), rest({1, 0.25, 0})},
                  {MovingPoint{{0.125, -1, 1}, {0.125, -1, -2}}, {{0, 1, 1}, {0, 1, -2}}}},
         {true, Rung::interval, around(below_third)});
}

TEST(ContactInterval, FirstOfThreeZeros) {
  // The face tilts about the x axis while the point crosses it: F is a cubic and changes sign more
  // than once.
  const VertexFace q = {
      {{0.1, 3, 1}, {0.1, -5, -1}},
      {{{{-9, -9, -4}, {-9, -9, 4}}, {{9, -9, -4}, {9, -9, 4}}, {{0, 9, 4}, {0, 9, -4}}}}};
  const ContactAnswer answer = vertex_face_contact(q, Want::first_time);
  ASSERT_TRUE(answer.contact);
  EXPECT_EQ(static_cast<int>(answer.rung), static_cast<int>(Rung::interval));
  EXPECT_LE(answer.first.hi, 0.5);
}

TEST(ContactQuadratic, AtABorderOfTheFaceOrOfTheStep) {
  expect(over_resting_face({2, 0, 1}, {2, 0, -1}), {true, Rung::quadratic, at(0.5)});
  expect(over_resting_face({4, 0, 3}, {4, 0, -1}), {true, Rung::quadratic, at(0.75)});
  expect(over_resting_face({1, 1, 0}, {1, 1, 5}), {true, Rung::quadratic, at(0)});
  expect(over_resting_face({1, 1, 5}, {1, 1, 0}), {true, Rung::quadratic, at(1)});
}

// The point moves along y, two corners of the face along z, and F = c (2t - 1)^2: at t=1/2 alone
// the face is a segment on the x axis, from 0 to 4, and the point is on that axis.
VertexFace double_zero(double x) {
  return {
      {{x, -1, 0}, {x, 1, 0}},
      {rest({0, 0, 0}), MovingPoint{{4, 0, -1}, {4, 0, 1}}, MovingPoint{{0, 0, -1}, {0, 0, 1}}}};
}

TEST(ContactQuadratic, DoubleZeroTouchesOrHasNoContact) {
  expect(double_zero(1), {true, Rung::quadratic, at(0.5)});
  expect(double_zero(4), {true, Rung::quadratic, at(0.5)});
  expect_none(double_zero(5));
}

// All in the plane y=0 but one corner. The point (2t, 0, 1) meets the line of the edge from the
// origin to (length, 0, length t) where 2 t^2 = 1, and the edge itself when that reaches so far.
VertexFace irrational_time(double length) {
  return {{{0, 0, 1}, {2, 0, 1}},
          {rest({0, 0, 0}), MovingPoint{{length, 0, 0}, {length, 0, length}}, rest({0, 4, 0})}};
}

TEST(ContactQuadratic, IrrationalTimeOnAnEdge) {
  const double root_half = 0x1.6a09e667f3bccp-1;  // the double below the square root of 1/2
  expect(irrational_time(3), {true, Rung::quadratic, around(root_half)});
  expect_none(irrational_time(1));
}

TEST(ContactDegenerate, NoMotion) {
  expect(over_resting_face({1, 1, 0}, {1, 1, 0}), {true, Rung::quadratic, at(0)});
  expect_none(over_resting_face({3, 3, 0}, {3, 3, 0}));
  EXPECT_TRUE(vertex_face_contact(over_resting_face({2, 2, 0}, {2, 2, 0}), Want::yes_no).contact);
}

TEST(ContactDegenerate, CoplanarThroughoutResting) {
  // In the plane of the face from outside over its edge x + y = 4.
  expect(over_resting_face({4, 4, 0}, {0, 0, 0}), {true, Rung::quadratic, at(0.5)});
  expect_none(over_resting_face({5, -1, 0}, {-1, -1, 0}));  // past the corner
  // Through the corner (4,0).
  expect(over_resting_face({5, -1, 0}, {3, 1, 0}), {true, Rung::quadratic, at(0.5)});
}

TEST(ContactDegenerate, EdgesTurningOnOneLine) {
  // At t=1/2 all four points are on the x axis, and the edges overlap there or do not.
  auto turning = [](double a, double b) {
    return std::array<MovingPoint, 2>{MovingPoint{{a, -1, 0}, {a, 1, 0}},
                                      MovingPoint{{b, 1, 0}, {b, -1, 0}}};
  };
  auto resting = [](double a, double b) {
    return std::array<MovingPoint, 2>{rest({a, 0, 0}), rest({b, 0, 0})};
  };
  EXPECT_TRUE(edge_edge_contact({turning(0, 2), resting(1, 3)}, Want::yes_no).contact);
  expect(EdgeEdge{turning(0, 2), resting(2, 3)}, {true, Rung::quadratic, at(0.5)});
  expect_none(EdgeEdge{turning(0, 2), resting(3, 4)});
}

TEST(ContactDegenerate, AllPointsCoincide) {
  const Point p = {1, 2, 3};
  expect(VertexFace{rest(p), {rest(p), rest(p), rest(p)}}, {true, Rung::quadratic, at(0)});
  expect(EdgeEdge{{rest(p), rest(p)}, {rest(p), rest(p)}}, {true, Rung::quadratic, at(0)});
}

TEST(ContactDegenerate, PointsMeetOnce) {
  const MovingPoint a = {{0, 0, 0}, {2, 4, 6}}, b = {{2, 4, 6}, {0, 0, 0}};
  expect(VertexFace{a, {b, b, b}}, {true, Rung::quadratic, at(0.5)});
  expect(EdgeEdge{{a, a}, {b, b}}, {true, Rung::quadratic, at(0.5)});
  const MovingPoint c = {{2, 4, 6}, {0, 1, 0}};
  expect_none(EdgeEdge{{a, a}, {c, c}});
}

TEST(ContactDegenerate, ZeroLengthEdgeThroughAnEdge) {
  const MovingPoint p = {{1, 0, 1}, {1, 0, -1}};
  expect(EdgeEdge{{p, p}, {rest({0, 0, 0}), rest({2, 0, 0})}}, {true, Rung::quadratic, at(0.5)});
  const MovingPoint miss = {{1, 0.5, 1}, {1, 0.5, -1}};
  expect_none(EdgeEdge{{miss, miss}, {rest({0, 0, 0}), rest({2, 0, 0})}});
}

TEST(ContactDegenerate, SliverFaceIsASegment) {
  VertexFace q = {{{1, 0, 1}, {1, 0, -1}}, {rest({0, 0, 0}), rest({1, 0, 0}), rest({2, 0, 0})}};
  expect(q, {true, Rung::quadratic, at(0.5)});
  q.vertex = {{3, 0, 1}, {3, 0, -1}};
  expect_none(q);
}

TEST(ContactDegenerate, ParallelEdgesSlide) {
  const EdgeEdge q = {{MovingPoint{{-3, 0, 0}, {1, 0, 0}}, {{-2, 0, 0}, {2, 0, 0}}},
                      {rest({0, 0, 0}), rest({1, 0, 0})}};
  expect(q, {true, Rung::quadratic, at(0.5)});
  EdgeEdge beside = q;
  beside.b = {rest({0, 1, 0}), rest({1, 1, 0})};
  expect(beside, {false, Rung::axis});
}

TEST(ContactDegenerate, FarFromTheOrigin) {
  const double far = 0x1p40;
  const VertexFace q = {
      {{far + 1, far + 1, far + 1}, {far + 1, far + 1, far - 1}},
      {rest({far, far, far}), rest({far + 4, far, far}), rest({far, far + 4, far})}};
  expect(q, {true, Rung::interval, at(0.5)});
}

TEST(ContactDegenerate, TimeBesideTheEnds) {
  const double tiny = 0x1p-1000;
  expect(over_resting_face({1, 1, tiny}, {1, 1, -1}),
         {true, Rung::interval, {std::nextafter(tiny, 0), tiny}});
  const double last = std::nextafter(1.0, 0.0);
  expect(over_resting_face({1, 1, 1}, {1, 1, -0x1p-60}), {true, Rung::interval, {last, 1}});
}

TEST(RungCounts, AddUp) {
  RungCounts counts;
  counts.add(Rung::axis);
  counts.add(Rung::interval);
  counts.add(Rung::quadratic);
  counts += counts;
  EXPECT_EQ(counts.axis, 2U);
  EXPECT_EQ(counts.interval, 2U);
  EXPECT_EQ(counts.quadratic, 2U);
}

// Segments that go through a triangle.

using Triangle = std::array<Point, 3>;

constexpr Triangle pierced_face = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

TEST(Piercing, ThroughTheInsideAndNotBeside) {
  EXPECT_TRUE(segment_pierces_triangle({1, 1, -1}, {1, 1, 1}, pierced_face));
  EXPECT_TRUE(segment_pierces_triangle({1, 1, 1}, {1, 1, -1}, pierced_face));
  EXPECT_FALSE(segment_pierces_triangle({3, 3, -1}, {3, 3, 1}, pierced_face));
  EXPECT_FALSE(segment_pierces_triangle({1, 1, 1}, {1, 1, 2}, pierced_face));
}

TEST(Piercing, TouchingIsNotPiercing) {
  EXPECT_FALSE(segment_pierces_triangle({1, 1, 0}, {1, 1, 1}, pierced_face));   // end on the face
  EXPECT_FALSE(segment_pierces_triangle({2, 0, -1}, {2, 0, 1}, pierced_face));  // through an edge
  EXPECT_FALSE(segment_pierces_triangle({4, 0, -1}, {4, 0, 1}, pierced_face));  // through a corner
  EXPECT_FALSE(segment_pierces_triangle({-1, 1, 0}, {5, 1, 0}, pierced_face));  // in the plane
  // What has shrunk does not pierce.
  EXPECT_FALSE(
      segment_pierces_triangle({1, 0, -1}, {1, 0, 1}, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}));
  EXPECT_FALSE(segment_pierces_triangle({1, 1, 0}, {1, 1, 0}, pierced_face));
}

TEST(Piercing, OneUlpDecides) {
  const double below = std::nextafter(0.1, 0), above = std::nextafter(0.1, 1);
  const Triangle at_height = {{{0, 0, 0.1}, {4, 0, 0.1}, {0, 4, 0.1}}};
  EXPECT_TRUE(segment_pierces_triangle({1, 1, below}, {1, 1, above}, at_height));
  EXPECT_FALSE(segment_pierces_triangle({1, 1, 0.1}, {1, 1, above}, at_height));
}

TEST(Piercing, ScalesOfAllDoubles) {
  test::Random random(31);
  int pierced = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<Point, 5> x;
    for (Point& p : x) {
      for (double& c : p) c = i % 2 == 0 ? random.unit() : random.integer(3);
    }
    const bool expected = segment_pierces_triangle(x[0], x[1], {x[2], x[3], x[4]});
    pierced += expected;
    EXPECT_EQ(segment_pierces_triangle(x[1], x[0], {x[3], x[2], x[4]}), expected);
    for (const int exponent : {-900, 1000}) {
      std::array<Point, 5> y = x;
      for (Point& p : y) {
        for (double& c : p) c = std::ldexp(c, exponent);
      }
      EXPECT_EQ(segment_pierces_triangle(y[0], y[1], {y[2], y[3], y[4]}), expected) << i;
    }
  }
  EXPECT_GT(pierced, 0);
}

// What is special about a contact.

template <class Query>
ContactShape shape(const Query& query) {
  const ContactAnswer answer = contact_of(four_points(query), Want::first_time);
  EXPECT_TRUE(answer.contact);
  return shape_of(four_points(query), answer.first);
}

TEST(ContactShape, OfAVertexThatFallsOnAFace) {
  const auto over_face = [](const Point& from, const Point& to) {
    return shape(over_resting_face(from, to));
  };
  EXPECT_EQ(over_face({1, 1, 1}, {1, 1, -1}), ContactShape::generic);
  EXPECT_EQ(over_face({2, 0, 1}, {2, 0, -1}), ContactShape::at_end_of_feature);
  EXPECT_EQ(over_face({2, 2, 2}, {2, 2, -1}), ContactShape::at_end_of_feature);
  EXPECT_EQ(over_face({0, 0, 1}, {0, 0, -1}), ContactShape::at_end_of_feature);
  EXPECT_EQ(over_face({9, 1, 0}, {1, 1, 0}), ContactShape::coplanar_throughout);
}

TEST(ContactShape, OfEdges) {
  const auto with_x = [](const MovingPoint& b0, const MovingPoint& b1) {
    return shape(EdgeEdge{{rest({-1, 0, 0}), rest({1, 0, 0})}, {b0, b1}});
  };
  EXPECT_EQ(with_x({{0, -1, 1}, {0, -1, -1}}, {{0, 1, 1}, {0, 1, -1}}), ContactShape::generic);
  EXPECT_EQ(with_x({{0, 0, 1}, {0, 0, -1}}, {{0, 1, 1}, {0, 1, -1}}),
            ContactShape::at_end_of_feature);
  EXPECT_EQ(with_x({{0, 0, 1}, {0, 0, -1}}, {{2, 0, 1}, {2, 0, -1}}), ContactShape::parallel_edges);
  EXPECT_EQ(with_x({{0, 3, 0}, {0, -1, 0}}, {{1, 4, 0}, {1, 5, 0}}),
            ContactShape::coplanar_throughout);
}

// F = 2 (2t - 1)^2: the first edge sweeps along y, the second rises along z and turns through a
// point, all at t = 1/2.
TEST(ContactShape, OfADoubleRoot) {
  const EdgeEdge q{{MovingPoint{{-1, -1, 0}, {-1, 1, 0}}, MovingPoint{{1, -1, 0}, {1, 1, 0}}},
                   {MovingPoint{{0, 0, -1}, {0, 0, 1}}, MovingPoint{{1, 1, -1}, {-1, -1, 1}}}};
  EXPECT_EQ(edge_edge_contact(q, Want::first_time).first, at(0.5));
  EXPECT_EQ(shape(q), ContactShape::double_root);
}

}  // namespace
}  // namespace assay::oracle
