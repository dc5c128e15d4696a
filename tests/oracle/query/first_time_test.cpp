#include "oracle/query/first_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "oracle/query/contact.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::MovingPoint;
using detector::Point;
using detector::TimeEnclosure;

MovingPoint still(Point p) { return {p, p}; }

// A vertex that comes down through z = 0 at t = from / (from - to).
Query falls(double from, double to) {
  return detector::VertexFace{{{.25, .25, from}, {.25, .25, to}},
                              {still({0, 0, 0}), still({1, 0, 0}), still({0, 1, 0})}};
}

// The same seen from a frame that is scaled by a power of two and shifted exactly.
Query scaled(const Query& query, double scale) {
  auto q = std::get<detector::VertexFace>(query);
  for (MovingPoint* p : {&q.vertex, &q.face[0], &q.face[1], &q.face[2]}) {
    for (std::size_t k = 0; k < 3; ++k) {
      p->t0[k] *= scale;
      p->t1[k] *= scale;
    }
  }
  return q;
}

TEST(FirstTime, ComparesTimesThatShareNoDouble) {
  const auto third = falls(1, -2), quarter = falls(1, -3);
  EXPECT_EQ(compare_first_times(quarter, third), std::strong_ordering::less);
  EXPECT_EQ(compare_first_times(third, quarter), std::strong_ordering::greater);
  EXPECT_EQ(compare_first_times(third, scaled(third, 0x1p-40)), std::strong_ordering::equal);
  EXPECT_EQ(compare_first_times(third, falls(1, 2)), std::nullopt);
}

TEST(FirstTime, TellsTimesApartThatShareAnEnclosure) {
  // The gap around 1/3 is 2^-54 wide; these differ by about 2^-70.
  const auto wide = detector::VertexFace{{{.25, .25, 1}, {.25, .25, -2}},
                                         {still({0, 0, 0}), still({1, 0, 0}), still({0, 1, 0})}};
  auto shifted = wide;
  for (auto& corner : shifted.face) corner.t0[2] = corner.t1[2] = 0x1p-70;
  const auto c = vertex_face_contact(shifted, detector::Want::first_time);
  const auto d = vertex_face_contact(wide, detector::Want::first_time);
  ASSERT_EQ(c.first, d.first) << "one gap of doubles";
  EXPECT_EQ(compare_first_times(shifted, wide), std::strong_ordering::less);
}

TEST(FirstTime, ComparesContactsAtTheEndsAndWithoutMotion) {
  const Query at_start = detector::VertexFace{
      still({.25, .25, 0}), {still({0, 0, 0}), still({1, 0, 0}), still({0, 1, 0})}};
  EXPECT_EQ(compare_first_times(at_start, falls(0, 1)), std::strong_ordering::equal);
  EXPECT_EQ(compare_first_times(falls(1, 0), at_start), std::strong_ordering::greater);
}

TEST(FirstTime, ClaimsAreCheckedBySigns) {
  const struct {
    Query query;
    TimeEnclosure claim;
    ClaimRung rung;
  } right[] = {
      {falls(1, -1), {.5, .5}, ClaimRung::signs},
      {falls(0, 1), {0, 0}, ClaimRung::signs},
      {falls(1, 0), {1, 1}, ClaimRung::signs},
      {falls(1, -2), {0x1.5555555555555p-2, 0x1.5555555555556p-2}, ClaimRung::signs},
  };
  for (const auto& r : right) {
    const auto verdict = check_first_time(r.query, r.claim);
    EXPECT_TRUE(verdict.holds) << r.claim.lo;
    EXPECT_EQ(verdict.rung, r.rung) << r.claim.lo;
  }
}

TEST(FirstTime, FalseClaimsAreRefused) {
  EXPECT_FALSE(check_first_time(falls(1, -1), {.25, .25}).holds);
  EXPECT_FALSE(check_first_time(falls(1, -1), {.5, std::nextafter(.5, 1)}).holds);
  EXPECT_FALSE(check_first_time(falls(1, -2), {.25, .5}).holds) << "not adjacent";
  EXPECT_FALSE(check_first_time(falls(1, 2), {.5, .5}).holds) << "no contact";
  EXPECT_FALSE(check_first_time(falls(1, -1), {-.5, -.5}).holds);
  EXPECT_FALSE(check_first_time(falls(1, -1), {1.5, 1.5}).holds);
}

TEST(FirstTime, RandomClaimsRightAndWrong) {
  test::Random random(20113);
  int contacts = 0, by_signs = 0;
  constexpr int cases = 2000;
  for (int i = 0; i < cases; ++i) {
    const bool integers = i % 2 == 0;
    const auto number = [&] { return integers ? random.integer(2) : random.unit(); };
    const auto point = [&] {
      return MovingPoint{{number(), number(), number()}, {number(), number(), number()}};
    };
    const detector::EdgeEdge query = {{point(), point()}, {point(), point()}};
    const auto answer = edge_edge_contact(query, detector::Want::first_time);
    if (!answer.contact) {
      EXPECT_FALSE(check_first_time(query, {.5, .5}).holds);
      continue;
    }
    ++contacts;
    const auto verdict = check_first_time(query, answer.first);
    EXPECT_TRUE(verdict.holds) << i;
    by_signs += verdict.rung == ClaimRung::signs ? 1 : 0;
    if (answer.first.hi < 1) {
      const double next = std::nextafter(answer.first.hi, 2.0);
      EXPECT_FALSE(check_first_time(query, {answer.first.hi, next}).holds) << i;
      EXPECT_FALSE(check_first_time(query, {next, next}).holds) << i;
    }
    if (answer.first.lo > 0) {
      const double before = std::nextafter(answer.first.lo, -1.0);
      EXPECT_FALSE(check_first_time(query, {before, answer.first.lo}).holds) << i;
    }
  }
  std::printf("%d queries, seed 20113: %d contacts, %d claims settled by signs alone\n", cases,
              contacts, by_signs);
  EXPECT_GT(contacts, cases / 8);
  EXPECT_GT(by_signs, contacts / 4);
}

// First contact times of random queries, ordered by the exact comparison and by their enclosures.
TEST(FirstTime, OrderAgreesWithEnclosures) {
  test::Random random(20114);
  std::vector<std::pair<Query, TimeEnclosure>> all;
  while (all.size() < 60) {
    const auto point = [&] {
      const auto n = [&] { return random.integer(2); };
      return MovingPoint{{n(), n(), n()}, {n(), n(), n()}};
    };
    const detector::EdgeEdge query = {{point(), point()}, {point(), point()}};
    const auto answer = edge_edge_contact(query, detector::Want::first_time);
    if (answer.contact && answer.first.lo > 0) all.emplace_back(query, answer.first);
  }
  for (const auto& [a, time_a] : all) {
    for (const auto& [b, time_b] : all) {
      const auto order = compare_first_times(a, b);
      ASSERT_TRUE(order.has_value());
      if (time_a < time_b) {
        EXPECT_EQ(order, std::strong_ordering::less);
      }
      if (time_b < time_a) {
        EXPECT_EQ(order, std::strong_ordering::greater);
      }
      if (time_a == time_b && time_a.lo == time_a.hi) {
        EXPECT_EQ(order, std::strong_ordering::equal);
      }
    }
  }
}

}  // namespace
}  // namespace assay::oracle
