#include "oracle/query/contact.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::Point;
using Triangle = std::array<Point, 3>;

constexpr Triangle pierced_face = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

TEST(Piercing, ThroughTheInside) {
  EXPECT_TRUE(segment_pierces_triangle({1, 1, -1}, {1, 1, 1}, pierced_face));
  EXPECT_TRUE(segment_pierces_triangle({1, 1, 1}, {1, 1, -1}, pierced_face));
}

TEST(Piercing, Beside) {
  EXPECT_FALSE(segment_pierces_triangle({3, 3, -1}, {3, 3, 1}, pierced_face));
  EXPECT_FALSE(segment_pierces_triangle({1, 1, 1}, {1, 1, 2}, pierced_face));
}

TEST(Piercing, TouchingIsNotPiercing) {
  EXPECT_FALSE(segment_pierces_triangle({1, 1, 0}, {1, 1, 1}, pierced_face));   // end on the face
  EXPECT_FALSE(segment_pierces_triangle({2, 0, -1}, {2, 0, 1}, pierced_face));  // through an edge
  EXPECT_FALSE(segment_pierces_triangle({4, 0, -1}, {4, 0, 1}, pierced_face));  // through a corner
  EXPECT_FALSE(segment_pierces_triangle({-1, 1, 0}, {5, 1, 0}, pierced_face));  // in the plane
}

TEST(Piercing, DegenerateIsNotPiercing) {
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
  constexpr int query_count = 2000;
  for (int i = 0; i < query_count; ++i) {
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
  std::printf("%d queries, %d pierced\n", query_count, pierced);
  EXPECT_GT(pierced, 0);
}

}  // namespace
}  // namespace assay::oracle
