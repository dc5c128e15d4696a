// Whether a surface is embedded, how near its triangles are to each other, and which of them are in
// contact.
#include "tests/oracle/embedding.h"

#include "oracle/instant/instant.h"
#include "oracle/mesh/step.h"
#include "oracle/query/contact.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Positions, detector::ViewPrimitive, test::positions, test::tetrahedron_triangles,
    test::triangles;

Positions tetrahedron(const detector::Point& top) {
  return positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, top});
}

TEST(Embedding, AtTheStart) {
  EXPECT_TRUE(embedded(tetrahedron({1, 1, 3}), tetrahedron_triangles));
  EXPECT_FALSE(embedded(tetrahedron({1, 1, 0}), tetrahedron_triangles));
  EXPECT_FALSE(embedded(test::intersecting_octahedron().x_t0, test::intersecting_octahedron().f));
  EXPECT_FALSE(embedded(tetrahedron({1, 1, 3}), triangles({{0, 1, 2}, {2, 1, 0}})));
}

TEST(Embedding, AtRationalTimes) {
  // The top is in the base at t=1/3, which is no double.
  const auto from = tetrahedron({1, 1, 1}), to = tetrahedron({1, 1, -2});
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {0, 1}));
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {333333333, 1000000000}));
  EXPECT_FALSE(embedded_at({from, to}, tetrahedron_triangles, {1, 3}));
  EXPECT_FALSE(embedded_at({from, to}, tetrahedron_triangles, {2, 6}));
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {333333334, 1000000000}));
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {1, 1}));
}

TEST(Embedding, PairsThatShareAnEdgeOrAVertex) {
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {-4, 0, 0}, {0, -4, 0}});
  EXPECT_FALSE(embedded(x, triangles({{0, 1, 2}, {1, 0, 3}})));  // folded flat upon itself
  EXPECT_FALSE(embedded(x, triangles({{0, 1, 2}, {0, 3, 5}})));  // one corner inside the other
  EXPECT_TRUE(embedded(x, triangles({{0, 1, 2}, {0, 4, 5}})));
  EXPECT_TRUE(embedded(x, triangles({{0, 1, 2}, {1, 0, 5}})));
}

bool meets(const ViewPrimitive& primitive, const Positions& to) {
  return meets_primitive({tetrahedron({0, 0, 4}), to}, tetrahedron_triangles, primitive);
}

bool meets(const ViewPrimitive& primitive) { return meets(primitive, tetrahedron({0, 0, 4})); }

ViewPrimitive point(const detector::Point& t0, const detector::Point& t1) {
  return {{t0, t1}, {t0, t1}};
}

ViewPrimitive segment(const detector::Point& a, const detector::Point& b) {
  return {{a, a}, {b, b}};
}

TEST(MeetsPrimitive, Point) {
  EXPECT_FALSE(meets(point({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5})));
  EXPECT_FALSE(meets(point({0.5, 0.5, 0.5}, {1, 1, 1})));
  EXPECT_TRUE(meets(point({0.5, 0.5, 0.5}, {2, 2, 2})));
  EXPECT_TRUE(meets(point({0.5, 0.5, 0.5}, {0.5, 0.5, 0})));                // touches at the end
  EXPECT_TRUE(meets(point({1, 1, 1}, {1, 1, 1}), tetrahedron({0, 0, 1})));  // the face comes
}

TEST(MeetsPrimitive, Segment) {
  EXPECT_FALSE(meets(segment({0.5, 0.5, 0.5}, {1, 1, 1})));
  EXPECT_FALSE(meets(segment({5, 5, 5}, {9, 5, 5})));
  EXPECT_TRUE(meets(segment({0.5, 0.5, 0.5}, {0.5, 0.5, -9})));  // pierces a face at rest
  EXPECT_TRUE(meets(segment({0.5, 0.5, 0.5}, {0.5, 0.5, 0})));   // ends on a face
  EXPECT_TRUE(meets(segment({1, 1, 0}, {2, 1, 0})));             // in the plane of a face, inside
  // An edge of the mesh comes to the segment.
  EXPECT_TRUE(meets(segment({2, -1, 0}, {2, -1, 9}), tetrahedron({8, -4, 4})));
  // A segment with ends that move apart, out through a face.
  EXPECT_TRUE(meets({{{0.5, 0.5, 0.5}, {0.5, 0.5, -1}}, {{1, 1, 1}, {1, 1, 1}}}));
}

const WantedPair all = [](std::int32_t, std::int32_t) { return true; };

// Two triangles, one above the other at this height, and moved along x.
detector::Positions above(double height, double aside = 0) {
  return positions({{0, 0, 0},
                    {4, 0, 0},
                    {0, 4, 0},
                    {aside + 1, 1, height},
                    {aside + 2, 1, height},
                    {aside + 1, 2, height}});
}
const detector::Triangles two = triangles({{0, 1, 2}, {3, 4, 5}});

TEST(Nearness, IsExactAtTheDistanceItself) {
  for (const double height : {0.5, 1e-300, 3e5, 0.1}) {
    EXPECT_FALSE(any_nearer_than(above(height), two, height, all)) << height;
    EXPECT_TRUE(any_nearer_than(above(height), two, std::nextafter(height, 1e9), all)) << height;
  }
}

TEST(Nearness, OfDistanceNoneIsContact) {
  EXPECT_FALSE(any_nearer_than(above(1e-300), two, 0, all));
  EXPECT_TRUE(any_nearer_than(above(0), two, 0, all));
}

TEST(Nearness, AsksOnlyThePairsThatCount) {
  EXPECT_FALSE(any_nearer_than(above(0), two, 1, [](std::int32_t, std::int32_t) { return false; }));
}

TEST(Nearness, OfEdgesAndOfFeaturesThatHaveShrunk) {
  // Edges that cross at a distance of 3, and no vertex is nearer to a face.
  const auto crossed =
      positions({{-9, 0, 0}, {9, 0, 0}, {0, 0, -9}, {0, -9, 3}, {0, 9, 3}, {0, 0, 12}});
  EXPECT_FALSE(any_nearer_than(crossed, two, 3, all));
  EXPECT_TRUE(any_nearer_than(crossed, two, 3.0001, all));
  // A triangle that is a point, and one that is a segment: 3-4-5.
  const auto shrunk =
      positions({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {3, 4, -1}, {3, 4, 1}, {3, 4, 0.5}});
  EXPECT_FALSE(any_nearer_than(shrunk, two, 5, all));
  EXPECT_TRUE(any_nearer_than(shrunk, two, 5.0001, all));
}

// Neighbours meet in what they share, which is no nearness.
TEST(Nearness, IgnoresWhatSharesAVertex) {
  const auto fan = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  EXPECT_FALSE(any_nearer_than(fan, triangles({{0, 1, 2}, {0, 3, 4}}), 0.5, all));
}

TEST(Nearness, AgreesWithEmbeddingOnRandomMeshes) {
  std::mt19937_64 engine(7);
  int contacts = 0;
  for (int i = 0; i < 200; ++i) {
    detector::Positions x(9, 3);
    for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = static_cast<double>(engine() % 7);
    const auto f = triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {2, 3, 6}});
    const bool meets = any_nearer_than(x, f, 0, all).has_value();
    EXPECT_EQ(meets, !embedded(x, f)) << "i = " << i;
    contacts += meets ? 1 : 0;
  }
  EXPECT_GT(contacts, 50);
  EXPECT_LT(contacts, 195);
}

// Contacts at an instant, beside those of a step in which nothing moves.

using test::Coordinates;

// The integer tests against the queries over a step in which nothing moves.
TEST(StaticContact, AgreesWithTheStepQueries) {
  test::Random random(11);
  int contacts = 0, pierced = 0;
  for (int i = 0; i < 30000; ++i) {
    const auto kind = static_cast<Coordinates>(i % test::coordinate_kinds);
    const detector::Positions x = random_rows(random, kind, 5);
    const Instant instant(x);
    const StaticPoints points = instant.points();
    auto p = [&](int v) { return detector::SteppedMesh{x, x}.path(v); };
    auto at = [&](int v) { return detector::point_of(x, v); };
    const auto no_time = detector::Want::yes_no;
    const bool vf = vertex_face_contact({p(0), {p(1), p(2), p(3)}}, no_time).contact;
    EXPECT_EQ(features_meet(points, {detector::FeatureKind::vertex_face, {0, 1, 2, 3, -1}}), vf);
    const bool ee = edge_edge_contact({{p(0), p(1)}, {p(2), p(3)}}, no_time).contact;
    EXPECT_EQ(features_meet(points, {detector::FeatureKind::edge_edge, {0, 1, 2, 3, -1}}), ee);
    const bool through = segment_pierces_triangle(at(0), at(1), {at(2), at(3), at(4)});
    EXPECT_EQ(features_meet(points, {detector::FeatureKind::piercing, {0, 1, 2, 3, 4}}), through);
    contacts += vf + ee;
    pierced += through;
  }
  EXPECT_GT(contacts, 300);
  EXPECT_GT(pierced, 100);
}

std::vector<detector::TrianglePair> judged(const detector::Positions& x,
                                           const detector::Triangles& f) {
  std::vector<detector::TrianglePair> pairs;
  for (const auto& contact : judge_step({x, x}, f, {}).pairs) pairs.push_back(contact.pair);
  return pairs;
}

TEST(InstantContacts, AreThoseOfAStepWithoutMotion) {
  test::Random random(12);
  for (int i = 0; i < 600; ++i) {
    const auto kind = static_cast<Coordinates>(i % test::coordinate_kinds);
    const detector::Positions x = random_rows(random, kind, 9);
    const detector::Triangles f = random_triangles(random, 9, 8);
    const auto expected = judged(x, f);
    EXPECT_EQ(contacts_at(Instant(x), f), expected);
    EXPECT_EQ(contacts_at(Instant(x), f, 2), expected);
    EXPECT_EQ(embedded(x, f), expected.empty());
  }
}

// A time at which all places are doubles: the rational instant must be the same as those doubles.
TEST(Instant, RationalTimesAreExact) {
  test::Random random(13);
  for (int i = 0; i < 300; ++i) {
    detector::Positions from = random_rows(random, Coordinates::tiny_grid, 8);
    const detector::Positions step = random_rows(random, Coordinates::tiny_grid, 8);
    const detector::Triangles f = random_triangles(random, 8, 6);
    const detector::Positions to = from + 3 * step;
    EXPECT_EQ(contacts_at(Instant({from, to}, {1, 3}), f), judged(from + step, f));
    EXPECT_EQ(contacts_at(Instant({from, to}, {3, 3}), f), judged(to, f));
    EXPECT_EQ(contacts_at(Instant({from, to}, {0, 7}), f), judged(from, f));
  }
}

TEST(Instant, BoxesEncloseWhatIsNoDouble) {
  const auto from = positions({{0, 1, -1}}), to = positions({{1, 1, 5e-324}});
  const Instant instant({from, to}, {1, 3});
  const Box& box = instant.box(0);
  EXPECT_LT(box.min[0], box.max[0]);
  EXPECT_LT(mpq_class(box.min[0]), mpq_class(1, 3));
  EXPECT_GT(mpq_class(box.max[0]), mpq_class(1, 3));
  EXPECT_EQ(box.min[1], 1);
  EXPECT_EQ(box.max[1], 1);
  EXPECT_EQ(instant.in_units(mpq_class(1, 3)), mpq_class(instant.points()[0][0]));
}

}  // namespace
}  // namespace assay::oracle
