// The rung "quadratic": queries with known times, and random queries compared with the algebraic
// kernel.
#include "oracle/query/rungs.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::MovingPoint, detector::Point, detector::TimeEnclosure, detector::Want,
    test::Coordinates, test::Random, test::rest;

TimeEnclosure exactly(double t) { return {t, t}; }
// A time that is no double, between t and the next.
TimeEnclosure just_above(double t) { return {t, std::nextafter(t, 2)}; }

// The first time of the query, asked for with and without its time; the algebraic kernel has to
// agree.
std::optional<TimeEnclosure> first_of(const FourPoints& q) {
  ContactPolynomials polynomials(q);
  const auto timed = quadratic_answer(polynomials, Want::first_time);
  const auto yes_no = quadratic_answer(polynomials, Want::yes_no);
  const ExactAnswer full = algebraic_answer(polynomials, Want::first_time);
  EXPECT_EQ(timed.contact, yes_no.contact);
  EXPECT_EQ(timed.contact, full.contact);
  EXPECT_EQ(timed.first, full.first);
  if (!timed.contact) return {};
  return timed.first;
}

// A point and a resting triangle in the plane z = 0, the plane lifted from z = 1 to z = 4.
FourPoints in_a_moving_plane(double x0, double y0, double x1, double y1) {
  auto lifted = [](double a, double b, double c, double d) {
    return MovingPoint{{a, b, 1}, {c, d, 4}};
  };
  return {{lifted(x0, y0, x1, y1), lifted(0, 0, 0, 0), lifted(4, 0, 4, 0), lifted(0, 4, 0, 4)}, 1};
}

TEST(QuadraticRung, CoplanarThroughout) {
  EXPECT_EQ(first_of(in_a_moving_plane(4, 4, 0, 0)), exactly(0.5));  // crosses the edge x + y = 4
  EXPECT_EQ(first_of(in_a_moving_plane(-1, 1, 2, 1)), just_above(0x1.5555555555555p-2));  // at 1/3
  EXPECT_EQ(first_of(in_a_moving_plane(1, 1, 9, 9)), exactly(0));   // begins inside
  EXPECT_EQ(first_of(in_a_moving_plane(0, 2, -9, 2)), exactly(0));  // begins on an edge and leaves
  EXPECT_EQ(first_of(in_a_moving_plane(9, 1, 3, 1)), exactly(1));   // ends on an edge
  EXPECT_EQ(first_of(in_a_moving_plane(9, 0, 4, 0)), exactly(1));   // ends in a corner
  EXPECT_EQ(first_of(in_a_moving_plane(5, -1, 3, 1)), exactly(0.5));  // touches a corner
  EXPECT_EQ(first_of(in_a_moving_plane(5, -1, -1, -1)), std::nullopt);
  EXPECT_EQ(first_of(in_a_moving_plane(9, 1, 3.5, 1)), std::nullopt);
}

TEST(QuadraticRung, CoplanarThroughoutTouchingAtOneInstant) {
  // The face is a segment in the plane z = 0: one end rests, the other passes over the point.
  const MovingPoint passing = {{3, -1, 0}, {-1, 3, 0}};
  EXPECT_EQ(first_of({{rest({1, 1, 0}), passing, passing, rest({9, 9, 0})}, 1}), exactly(0.5));
}

TEST(QuadraticRung, CoplanarThroughoutAtAnIrrationalTime) {
  // In the plane y = 0: the lower end (2t, 0, 1) of a needle meets the edge from the origin to
  // (length, 0, length t) where 2 t^2 = 1, or passes beyond the end of it.
  auto query = [](double length) {
    return FourPoints{{MovingPoint{{0, 0, 1}, {2, 0, 1}}, MovingPoint{{0, 0, 9}, {2, 0, 9}},
                       rest({0, 0, 0}), MovingPoint{{length, 0, 0}, {length, 0, length}}},
                      2};
  };
  EXPECT_EQ(first_of(query(3)), just_above(0x1.6a09e667f3bccp-1));
  EXPECT_EQ(first_of(query(1)), std::nullopt);
}

TEST(QuadraticRung, CoplanarThroughoutWithADoubleZero) {
  // In the plane z = 0: the edge from (2t - 1, 2t - 1) to (1 - 2t, 2t - 1) is as long as it is far
  // from the line y = 0, so at the origin L of the third corner is a multiple of (2t - 1)^2.
  const MovingPoint left = {{-1, -1, 0}, {1, 1, 0}}, right = {{1, -1, 0}, {-1, 1, 0}};
  auto query = [&](double x, const MovingPoint& corner) {
    return FourPoints{{rest({x, 0, 0}), left, right, corner}, 1};
  };
  EXPECT_EQ(first_of(query(0, rest({0, -9, 0}))), exactly(0.5));  // from then on
  EXPECT_EQ(first_of(query(0, left)), exactly(0.5));              // then alone
  EXPECT_EQ(first_of(query(0.25, left)), std::nullopt);
  EXPECT_EQ(first_of(query(2, rest({0, -9, 0}))), std::nullopt);
}

TEST(QuadraticRung, CollinearThroughout) {
  auto on_a_line = [](double a, double b) { return MovingPoint{{a, a, a}, {b, b, b}}; };
  const MovingPoint two = on_a_line(2, 2), nine = on_a_line(9, 9), same = on_a_line(1, 2);
  EXPECT_EQ(first_of({{on_a_line(0, 3), on_a_line(1, 4), two, nine}, 2}),
            just_above(0x1.5555555555555p-2));
  EXPECT_EQ(first_of({{on_a_line(0, 0.5), on_a_line(1, 1.5), two, nine}, 2}), std::nullopt);
  EXPECT_EQ(first_of({{same, same, same, same}, 2}), exactly(0));
}

// The point (2t, 0, 1), the face (0,0,0), (length, 0, length t), (0, y, 0) where y goes from 4 to
// `last`: F is a multiple of y (2 t^2 - 1), and so is L of the third corner.
FourPoints cubic_with_a_quadratic_factor(double length, double last) {
  return {{MovingPoint{{0, 0, 1}, {2, 0, 1}}, rest({0, 0, 0}),
           MovingPoint{{length, 0, 0}, {length, 0, length}}, MovingPoint{{0, 4, 0}, {0, last, 0}}},
          1};
}

TEST(QuadraticRung, ContactsOnTheBorderOfAFace) {
  const TimeEnclosure root_half = just_above(0x1.6a09e667f3bccp-1);
  EXPECT_EQ(first_of(cubic_with_a_quadratic_factor(3, 4)), root_half);  // no cubic yet
  EXPECT_EQ(first_of(cubic_with_a_quadratic_factor(3, 8)), root_half);
  EXPECT_EQ(first_of(cubic_with_a_quadratic_factor(1, 8)), std::nullopt);
  // The face is flat from 4/5 on, after the contact; then at 2/5, before it, without one.
  EXPECT_EQ(first_of(cubic_with_a_quadratic_factor(3, -1)), root_half);
  EXPECT_EQ(first_of(cubic_with_a_quadratic_factor(1, -6)), std::nullopt);
}

TEST(QuadraticRung, ACubeRoot) {
  // F = t^3 - 1/2, and the weights of the corners are as 1 : t : t^2.
  const FourPoints q = {{rest({0, 0, 0}), MovingPoint{{0, 0, -0.5}, {1, 0, -0.5}},
                         MovingPoint{{-1, 0, 0}, {-1, 1, 0}}, MovingPoint{{0, -1, 0}, {0, -1, 1}}},
                        1};
  EXPECT_EQ(first_of(q), just_above(0x1.965fea53d6e3cp-1));
}

// What makes a query degenerate throughout.
enum class Shape { free, mirrored, planar, sheared_plane, common_motion, on_a_line };
constexpr int shapes = 6;

// Mirrors at x = 0.
MovingPoint mirrored(const MovingPoint& p) {
  return {{-p.t0[0], p.t0[1], p.t0[2]}, {-p.t1[0], p.t1[1], p.t1[2]}};
}

FourPoints random_query(Random& random, Coordinates kind, Shape shape) {
  FourPoints q;
  q.first_group = 1 + random.below(2);
  for (MovingPoint& p : q.points) p = test::random_point(random, kind);
  auto each_end = [&](const auto& change) {
    for (MovingPoint& p : q.points) {
      change(p.t0);
      change(p.t1);
    }
  };
  switch (shape) {
    case Shape::free:
      break;
    case Shape::mirrored:
      q.points[2] = mirrored(q.points[0]);
      if (random.below(2) == 0) q.points[3] = mirrored(q.points[1]);
      break;
    case Shape::planar: {
      const double z0 = random.integer(3), z1 = random.integer(3);
      for (MovingPoint& p : q.points) p.t0[2] = z0, p.t1[2] = z1;
      break;
    }
    case Shape::sheared_plane:
      each_end([](Point& p) { p[2] = -p[0]; });
      break;
    case Shape::common_motion: {
      const MovingPoint first = q.points[0];
      for (int i = 1; i < 4; ++i) {
        if (random.below(3) == 0) continue;
        for (int k = 0; k < 3; ++k)
          q.points[i].t1[k] = q.points[i].t0[k] + (first.t1[k] - first.t0[k]);
      }
      break;
    }
    case Shape::on_a_line:
      each_end([](Point& p) { p[1] = p[2] = p[0]; });
      break;
  }
  if (random.below(6) == 0) q.points[3] = q.points[random.below(3)];
  return q;
}

TEST(QuadraticRung, AgreesWithTheAlgebraicKernel) {
  Random random(32);
  constexpr int queries_of_a_kind = tests::usual(120);
  for (int shape = 0; shape < shapes; ++shape) {
    int contacts = 0;
    for (int kind = 0; kind < test::coordinate_kinds; ++kind) {
      for (int i = 0; i < queries_of_a_kind; ++i) {
        contacts += first_of(random_query(random, static_cast<Coordinates>(kind),
                                          static_cast<Shape>(shape)))
                        .has_value();
        ASSERT_FALSE(testing::Test::HasFailure()) << shape << " " << kind << " " << i;
      }
    }
    EXPECT_GT(contacts, 0);
  }
}

// The vertex is put on an edge of the face at t = 1/2, all else is free.
TEST(QuadraticRung, RandomContactsOnBorders) {
  Random random(33);
  int cubics = 0;
  for (int i = 0; i < 200; ++i) {
    FourPoints q;
    for (MovingPoint& p : q.points) p = test::random_point(random, Coordinates::tiny_grid);
    for (int k = 0; k < 3; ++k) {  // x0 = (x1 + x2) / 2 at t = 1/2
      q.points[0].t1[k] =
          (q.points[1].t0[k] + q.points[1].t1[k] + q.points[2].t0[k] + q.points[2].t1[k]) / 2 -
          q.points[0].t0[k];
    }
    ContactPolynomials polynomials(q);
    cubics += polynomials.coplanarity().degree() == 3;
    const auto first = first_of(q);
    ASSERT_TRUE(first) << i;
    EXPECT_LE(first->lo, 0.5);
  }
  EXPECT_GT(cubics, 100);
}

}  // namespace
}  // namespace assay::oracle
