// The second referee: named cases, agreement with contact.h, and how much it leaves open.
#include "oracle/referee/referee.h"

#include "oracle/query/contact.h"
#include "oracle/referee/existence.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::oracle {
namespace {

using detector::EdgeEdge, detector::MovingPoint, detector::Point, detector::VertexFace,
    detector::Decision, detector::FourPoints, test::edge_edge, test::Points, test::QueryKind,
    test::Random, test::rest, test::resting_face, test::vertex_face;

Decision over_resting_face(const Point& from, const Point& to) {
  return referee(four_points(VertexFace{{from, to}, resting_face}));
}

TEST(Referee, VertexThroughAFace) {
  EXPECT_EQ(over_resting_face({1, 1, 1}, {1, 1, -1}), Decision::yes);
  EXPECT_EQ(over_resting_face({1, 1, 1}, {1, 1, -.7}), Decision::yes);
  EXPECT_EQ(over_resting_face({3, 3, 1}, {3, 3, -1}), Decision::no);
}

TEST(Referee, TouchingCounts) {
  EXPECT_EQ(over_resting_face({1, 1, 1}, {1, 1, 0}), Decision::yes);   // at t=1
  EXPECT_EQ(over_resting_face({1, 1, 0}, {1, 1, 1}), Decision::yes);   // at t=0
  EXPECT_EQ(over_resting_face({0, 0, 1}, {0, 0, -1}), Decision::yes);  // a corner
  EXPECT_EQ(over_resting_face({2, 2, 1}, {2, 2, -2}), Decision::yes);  // t=1/3, an edge
  EXPECT_EQ(over_resting_face({-1, 1, 0}, {5, 1, 0}), Decision::yes);  // in its plane
  EXPECT_EQ(over_resting_face({-1, 5, 0}, {5, 5, 0}), Decision::no);
}

// Through a resting face at t = 1/2, and through one that rises meanwhile.
TEST(Referee, AskedUpToATime) {
  const auto up_to = [](const VertexFace& query, double until) {
    return referee(four_points(query), RefereeOptions{.until = until});
  };
  const VertexFace half{{{1, 1, 1}, {1, 1, -1}}, resting_face};
  EXPECT_EQ(up_to(half, 1), Decision::yes);
  EXPECT_EQ(up_to(half, .5), Decision::yes);
  EXPECT_EQ(up_to(half, .75), Decision::yes);
  EXPECT_EQ(up_to(half, .25), Decision::no);
  EXPECT_NE(up_to(half, std::nextafter(.5, 0)), Decision::yes);
  // The vertex falls as 1 - t, and below it the face rises as 2 t: they meet at t = 1/3.
  VertexFace rising = half;
  rising.vertex = {{1, 1, 1}, {1, 1, 0}};
  rising.face = {{{{0, 0, 0}, {0, 0, 0}}, {{4, 0, 0}, {4, 0, 4}}, {{0, 4, 0}, {0, 4, 4}}}};
  ASSERT_EQ(up_to(rising, 1), Decision::yes);
  EXPECT_EQ(up_to(rising, .75), Decision::yes);
  EXPECT_EQ(up_to(rising, .125), Decision::no);
}

TEST(Referee, OneUnitInTheLastPlaceDecides) {
  const double below = std::nextafter(0.0, -1), above = std::nextafter(0.0, 1);
  EXPECT_EQ(over_resting_face({1, 1, 1}, {1, 1, below}), Decision::yes);
  EXPECT_EQ(over_resting_face({1, 1, 1}, {1, 1, above}), Decision::no);
  EXPECT_EQ(over_resting_face({above, 1, 1}, {above, 1, -1}), Decision::yes);
  EXPECT_EQ(over_resting_face({below, 1, 1}, {below, 1, -1}), Decision::no);
}

TEST(Referee, ParallelAndZeroLengthEdges) {
  const auto edges = [](const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
    const auto falls = [](const Point& p) { return MovingPoint{p, {p[0], p[1], p[2] - 2}}; };
    return referee(four_points(EdgeEdge{{falls(a0), falls(a1)}, {rest(b0), rest(b1)}}));
  };
  EXPECT_EQ(edges({0, 0, 1}, {2, 0, 1}, {1, 0, 0}, {3, 0, 0}), Decision::yes);
  EXPECT_EQ(edges({0, 0, 1}, {2, 0, 1}, {3, 0, 0}, {4, 0, 0}), Decision::no);
  EXPECT_EQ(edges({1, 0, 1}, {1, 0, 1}, {0, 0, 0}, {3, 0, 0}), Decision::yes);
  EXPECT_EQ(edges({1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {1, 0, 0}), Decision::yes);
}

TEST(Referee, NoMotion) {
  EXPECT_EQ(over_resting_face({1, 1, 0}, {1, 1, 0}), Decision::yes);
  EXPECT_EQ(over_resting_face({1, 1, 1}, {1, 1, 1}), Decision::no);
}

TEST(Referee, ExtremeNumbers) {
  constexpr double huge = 0x1.fffffffffffffp1023, tiny = 0x1p-1074;
  const auto scaled = [](double s, double z) {
    return referee(four_points(VertexFace{{{s / 4, s / 4, z}, {s / 4, s / 4, -z}},
                                          {rest({-s, -s, 0}), rest({s, -s, 0}), rest({0, s, 0})}}));
  };
  EXPECT_EQ(scaled(huge, huge), Decision::yes);
  EXPECT_EQ(scaled(4 * tiny, tiny), Decision::yes);
  EXPECT_EQ(scaled(huge, tiny), Decision::yes);
  EXPECT_EQ(over_resting_face({1, 1, tiny}, {1, 1, huge}), Decision::no);
}

// Within a plane, a flat face sweeps over a vertex at an irrational time: coplanar throughout, so
// no crossing, and nothing to be seen at rational times.
TEST(Referee, IrrationalTouchStaysOpen) {
  // The face is a segment from (1, t) to (-2t, -1). Its line holds the origin where the two are
  // parallel, -1 + 2 t^2 = 0.
  const MovingPoint p = {{1, 0, 0}, {1, 1, 0}}, q = {{0, -1, 0}, {-2, -1, 0}};
  const VertexFace touch = {rest({0, 0, 0}), {p, q, q}};
  const ContactAnswer answer = vertex_face_contact(touch, detector::Want::first_time);
  ASSERT_TRUE(answer.contact);
  EXPECT_EQ(answer.first.lo, std::nextafter(std::sqrt(.5), 0));
  EXPECT_EQ(referee(four_points(touch)), Decision::open);
}

TEST(Referee, LessDepthOnlyLeavesMoreOpen) {
  Random random(31);
  for (int i = 0; i < 300; ++i) {
    const Points x = random_query(random, QueryKind::generic, 1);
    const Decision full = referee({x, 1});
    for (const int depth : {0, 3, 8}) {
      const Decision part = referee({x, 1}, {depth, 1000});
      EXPECT_TRUE(part == full || part == Decision::open) << i << " depth " << depth;
    }
    EXPECT_TRUE(referee({x, 1}, {60, 0}) == Decision::open);
  }
}

// ORACLE: every "no" of generic queries is confirmed at a depth of 17.
TEST(Referee, DepthSeventeenConfirmsEveryNo) {
  Random random(32);
  for (int i = 0; i < 4000; ++i) {
    const int first_group = 1 + i % 2;
    const Points x = random_query(random, QueryKind::generic, first_group);
    if (contact_of({x, first_group}, detector::Want::yes_no).contact) continue;
    EXPECT_EQ(referee(FourPoints{x, first_group}, {17, 1000}), Decision::no) << i;
  }
}

struct Tally {
  int contact = 0, open = 0;
};

Tally compare_with_contact(QueryKind kind, std::uint64_t seed, int queries) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < queries; ++i) {
    const int first_group = 1 + i % 2;
    const FourPoints q = {random_query(random, kind, first_group), first_group};
    const Decision verdict = referee(q);
    const bool contact = contact_of(q, detector::Want::yes_no).contact;
    const bool is_open = verdict == Decision::open;
    EXPECT_TRUE(is_open || contact == (verdict == Decision::yes))
        << test::name_of(kind) << ", seed " << seed << ", query " << i;
    tally.open += is_open;
    tally.contact += contact && !is_open;
  }
  return tally;
}

TEST(Referee, AgreesAndLeavesLittleOpen) {
  for (int k = 0; k < test::query_kinds; ++k) {
    const auto kind = static_cast<QueryKind>(k);
    constexpr int queries = tests::usual(1500);
    const Tally tally = compare_with_contact(kind, 41 + static_cast<std::uint64_t>(k), queries);
    const bool is_plain = kind == QueryKind::generic || kind == QueryKind::mesh_like;
    EXPECT_LE(tally.open, (is_plain ? 0.05 : test::is_near_degenerate(kind) ? 0.5 : 1) * queries);
    EXPECT_GT(tally.contact, 0);
  }
}

TEST(SeparationProof, ADirectionThatTurnsAndOneThatStays) {
  // A vertex that passes over a face at a distance of 1: separated in one piece.
  const auto over = four_points(VertexFace{{{0, 0, 1}, {4, 4, 1}}, resting_face});
  EXPECT_EQ(separated_in_double(double_hull(over), 0, 1), SeparationProof::separated);
  EXPECT_TRUE(separated_in_integers(integer_hull(over), 0, 0));
  const auto through = four_points(VertexFace{{{1, 1, 1}, {1, 1, -1}}, resting_face});
  EXPECT_EQ(separated_in_double(double_hull(through), 0, 1), SeparationProof::not_found);
  EXPECT_FALSE(separated_in_integers(integer_hull(through), 0, 0));
  EXPECT_FALSE(separated_in_integers(integer_hull(through), 1, 1));  // touches at 1/2
  EXPECT_TRUE(separated_in_integers(integer_hull(through), 3, 2));
}

TEST(SeparationProof, DoublesDoNotClaimWhatTheyCannotTell) {
  // One unit in the last place above the plane of a far face: only integers can tell.
  const double z = std::nextafter(1e6, 2e6);
  const VertexFace q = {rest({1e6 + 1, 1e6 + 1, z}),
                        {rest({1e6, 1e6, 1e6}), rest({1e6 + 4, 1e6, 1e6}),
                         MovingPoint{{1e6, 1e6 + 4, 1e6}, {1e6, 1e6 + 4, z}}}};
  EXPECT_TRUE(separated_in_integers(integer_hull(four_points(q)), 0, 0));
}

TEST(Existence, SimplestFractions) {
  EXPECT_EQ(simplest_fraction(0, 0), (Fraction{0, 1}));
  EXPECT_EQ(simplest_fraction(1, 1), (Fraction{1, 1}));
  EXPECT_EQ(simplest_fraction(1, 2), (Fraction{1, 2}));
  EXPECT_EQ(simplest_fraction(5, 4), (Fraction{1, 3}));        // [5/16, 6/16]
  EXPECT_EQ(simplest_fraction(349525, 20), (Fraction{1, 3}));  // 349525.33 / 2^20
  for (int depth = 1; depth <= 61; depth += 12) {
    const std::int64_t k = (std::int64_t{1} << depth) / 7 * 5;
    const Fraction f = simplest_fraction(k, depth);
    const mpz_class scaled = mpz_class(static_cast<long>(f.p)) << static_cast<unsigned>(depth);
    const mpz_class lower = mpz_class(static_cast<long>(k)) * static_cast<long>(f.q);
    EXPECT_GE(scaled, lower);
    EXPECT_LE(scaled, mpz_class(lower + static_cast<long>(f.q)));
  }
}

TEST(Existence, OriginInDegenerateHulls) {
  const auto holds = [](const std::array<Point, 3>& face) {
    const VertexFace q = {rest({0, 0, 0}), {rest(face[0]), rest(face[1]), rest(face[2])}};
    return contains_origin(integer_hull(four_points(q)).t0);
  };
  EXPECT_TRUE(holds({{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}}}));
  EXPECT_TRUE(holds({{{0, -1, 0}, {0, 1, 0}, {5, 0, 0}}}));  // on an edge
  EXPECT_FALSE(holds({{{-1, -1, 1}, {2, -1, 0}, {-1, 2, 0}}}));
  EXPECT_TRUE(holds({{{-1, -1, -1}, {2, 2, 2}, {3, 3, 3}}}));  // a segment
  EXPECT_FALSE(holds({{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}}));
  EXPECT_TRUE(holds({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}));  // a point
  EXPECT_FALSE(holds({{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}}));
}

TEST(Existence, BoxesProveCrossingsAndNothingElse) {
  const auto through = four_points(VertexFace{{{1, 1, 1}, {1.1, .9, -1.7}}, resting_face});
  const auto guess = guess_crossing(double_hull(through), 0, 1);
  ASSERT_TRUE(guess.has_value());
  EXPECT_TRUE(crossing_in_a_box(integer_hull(through), *guess));
  const auto beside = four_points(VertexFace{{{3, 3, 1}, {3.1, 2.9, -1.7}}, resting_face});
  EXPECT_FALSE(guess_crossing(double_hull(beside), 0, 1).has_value());
  // A wrong guess proves nothing.
  EXPECT_FALSE(crossing_in_a_box(integer_hull(beside), *guess));
  EXPECT_FALSE(crossing_in_a_box(integer_hull(through), {.9, .3, .3, 0}));
}

// Contacts that begin and end between neighbouring doubles, and what is no proof.

// A vertex over a face whose plane turns: z = t x, raised by `above` at two corners. The vertex
// moves along the tangent of its path in that plane at t = 1/2, so that F has two zeros there,
// which are sqrt(above) away from 1/2, or none where `above` is negative.
detector::FourPoints grazing(double above, double y = .2) {
  return four_points(VertexFace{{{.25, y, -.125}, {.75, y, .625}},
                                {{{{0, 0, -above}, {0, 0, -above}},
                                  {{0, 1, -above}, {0, 1, -above}},
                                  {{1, 0, 0}, {1, 0, 1}}}}});
}

TEST(RationalBracket, FindsWhatBeginsAndEndsAtOneDouble) {
  for (const int exponent : {-40, -80, -110, -200}) {
    EXPECT_TRUE(meet_between(grazing(std::ldexp(1, exponent)), .25, .75)) << exponent;
    EXPECT_FALSE(meet_between(grazing(-std::ldexp(1, exponent)), .25, .75)) << exponent;
  }
}

TEST(RationalBracket, NamesNoContactBesideTheFace) {
  EXPECT_FALSE(meet_between(grazing(0x1p-40, .6), .25, .75));
  EXPECT_FALSE(meet_between(grazing(0x1p-40), .75, 1));
}

// A time told is late only if the contact is before it, so neither end belongs to the interval.
TEST(RationalBracket, TheEndsDoNotBelongToTheInterval) {
  const auto at_half = four_points(VertexFace{{{1, 1, 1}, {1, 1, -1}}, resting_face});
  EXPECT_TRUE(meet_between(at_half, .25, .75));
  EXPECT_TRUE(meet_between(at_half, 0, 1));
  EXPECT_FALSE(meet_between(at_half, .25, .5));
  EXPECT_FALSE(meet_between(at_half, .5, 1));
}

void expect_what_the_oracle_says(const FourPoints& query, int& contacts) {
  const ContactAnswer answer = contact_of(query, detector::Want::first_time);
  EXPECT_EQ(meet_between(query, 0, 1), answer.contact);
  contacts += answer.contact;
  if (!answer.contact || answer.first.lo == answer.first.hi) return;
  EXPECT_TRUE(meet_between(query, answer.first.lo, answer.first.hi));
  EXPECT_FALSE(meet_between(query, 0, answer.first.lo));
}

TEST(RationalBracket, SaysWhatTheOracleSaysOfGenericQueries) {
  test::Random random(22);
  const auto point = [&] { return test::random_point(random, test::Coordinates::generic); };
  int contacts = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    for (const int first_group : {1, 2})
      expect_what_the_oracle_says({{point(), point(), point(), point()}, first_group}, contacts);
  }
  EXPECT_GT(contacts, 40);
}

}  // namespace
}  // namespace assay::oracle
