#include "oracle/instant/instant.h"
#include "oracle/mesh/step.h"
#include "oracle/query/contact.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using test::Coordinates;

detector::Positions random_rows(test::Random& random, Coordinates kind, int count) {
  detector::Positions x(count, 3);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) x(i, k) = test::random_coordinate(random, kind);
  }
  return x;
}

// The integer tests against the queries over a step in which nothing moves.
TEST(StaticContact, AgreesWithTheStepQueries) {
  test::Random random(11);
  int met = 0, pierced = 0;
  for (int i = 0; i < 30000; ++i) {
    const auto kind = static_cast<Coordinates>(i % test::coordinate_kinds);
    const detector::Positions x = random_rows(random, kind, 5);
    const Instant instant(x);
    const StaticPoints points = instant.points();
    auto p = [&](int v) { return detector::SteppedMesh{x, x}.path(v); };
    auto at = [&](int v) { return detector::point_of(x, v); };
    const auto no_time = detector::Want::yes_no;
    const bool vf = vertex_face_contact({p(0), {p(1), p(2), p(3)}}, no_time).contact;
    EXPECT_EQ(vertex_meets_face(points, 0, {1, 2, 3}), vf);
    const bool ee = edge_edge_contact({{p(0), p(1)}, {p(2), p(3)}}, no_time).contact;
    EXPECT_EQ(edges_meet(points, {0, 1}, {2, 3}), ee);
    const bool through = segment_pierces_triangle(at(0), at(1), {at(2), at(3), at(4)});
    EXPECT_EQ(edge_pierces_face(points, {0, 1}, {2, 3, 4}), through);
    met += vf + ee;
    pierced += through;
  }
  std::printf("%d contacts, %d pierced\n", met, pierced);
  EXPECT_GT(met, 300);
  EXPECT_GT(pierced, 100);
}

detector::Triangles random_triangles(test::Random& random, int vertices, int count) {
  detector::Triangles f(count, 3);
  for (int t = 0; t < count; ++t) {
    do {
      for (int k = 0; k < 3; ++k) f(t, k) = random.below(vertices);
    } while (f(t, 0) == f(t, 1) || f(t, 1) == f(t, 2) || f(t, 2) == f(t, 0));
  }
  return f;
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
    EXPECT_EQ(any_contact_at(Instant(x), f), !expected.empty());
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
    const detector::Positions third = from + step;
    EXPECT_EQ(contacts_at(Instant({from, to}, {1, 3}), f), judged(third, f));
    EXPECT_EQ(contacts_at(Instant({from, to}, {3, 3}), f), judged(to, f));
    EXPECT_EQ(contacts_at(Instant({from, to}, {0, 7}), f), judged(from, f));
  }
}

TEST(Instant, BoxesEncloseWhatIsNoDouble) {
  const auto from = test::positions({{0, 1, -1}}), to = test::positions({{1, 1, 5e-324}});
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
