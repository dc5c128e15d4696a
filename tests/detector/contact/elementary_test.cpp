#include "detector/contact/elementary.h"

#include "detector/contact/rungs.h"
#include "tests/detector/contact/query_draw.h"
#include "tests/detector/points.h"
#include "tests/detector/small_stack.h"

namespace assay::detector {
namespace {

using tests::still;

const std::array<MovingPoint, 3> unit_triangle = {still({0, 0, 0}), still({1, 0, 0}),
                                                  still({0, 1, 0})};

FourPoints vertex_moves(Point from, Point to) {
  return four_points(VertexFace{{from, to}, unit_triangle});
}

struct NamedQuery {
  const char* name;
  FourPoints query;
  std::optional<double> time;  // of the first contact
  ContactRung rung;
};

std::vector<NamedQuery> named_queries() {
  constexpr auto never = std::nullopt;
  const auto ee = [](MovingPoint a0, MovingPoint a1, MovingPoint b0, MovingPoint b1) {
    return four_points(EdgeEdge{{a0, a1}, {b0, b1}});
  };
  return {
      {"far away", vertex_moves({5, 5, 5}, {6, 5, 5}), never, ContactRung::axis},
      {"stays above", vertex_moves({.2, .2, 1}, {.3, .3, 1}), never, ContactRung::axis},
      {"passes beside", vertex_moves({.9, .9, 1}, {.9, .9, -1}), never, ContactRung::filter},
      {"through the face", vertex_moves({.25, .25, 1}, {.25, .25, -1}), .5, ContactRung::filter},
      {"onto an edge", vertex_moves({.5, 0, 1}, {.5, 0, -1}), .5, ContactRung::fixed},
      {"onto a corner", vertex_moves({0, 0, 1}, {0, 0, -1}), .5, ContactRung::fixed},
      {"touches at t=1", vertex_moves({.25, .25, 1}, {.25, .25, 0}), 1, ContactRung::fixed},
      {"leaves at t=0", vertex_moves({.25, .25, 0}, {.25, .25, 1}), 0, ContactRung::fixed},
      {"no motion, inside", vertex_moves({.25, .25, 0}, {.25, .25, 0}), 0, ContactRung::fixed},
      {"no motion, in the plane outside", vertex_moves({.75, .75, 0}, {.75, .75, 0}), never,
       ContactRung::filter},
      {"in the plane, enters", vertex_moves({-1, .25, 0}, {1, .25, 0}), .5, ContactRung::fixed},
      {"triangle of one point, met",
       four_points(VertexFace{{{-1, 0, 0}, {3, 0, 0}},
                              {still({1, 0, 0}), still({1, 0, 0}), still({1, 0, 0})}}),
       .5, ContactRung::fixed},
      {"collinear throughout, no contact",
       four_points(VertexFace{{{5, 0, 0}, {4, 0, 0}},
                              {still({0, 0, 0}), still({1, 0, 0}), still({2, 0, 0})}}),
       never, ContactRung::axis},
      {"crossing edges",
       ee(still({-1, 0, 0}), still({1, 0, 0}), {{0, -1, 1}, {0, -1, -1}}, {{0, 1, 1}, {0, 1, -1}}),
       .5, ContactRung::filter},
      {"parallel edges meet in a stretch",
       ee(still({0, 0, 0}), still({2, 0, 0}), {{1, 0, 1}, {1, 0, -1}}, {{3, 0, 1}, {3, 0, -1}}), .5,
       ContactRung::fixed},
      {"edges meet at end points",
       ee(still({0, 0, 0}), still({1, 0, 0}), {{1, 0, 1}, {1, 0, 0}}, {{2, 1, 1}, {2, 1, 0}}), 1,
       ContactRung::fixed},
      {"zero-length edge meets an edge",
       ee(still({0, 0, 0}), still({2, 0, 0}), {{1, 1, 0}, {1, -1, 0}}, {{1, 1, 0}, {1, -1, 0}}), .5,
       ContactRung::fixed},
      {"double root: rises, touches, sinks",
       ee({{-1, -1, 0}, {1, -1, 0}}, {{-1, 1, 0}, {1, 1, 0}}, still({0, 0, 0}), still({0, 0, 1})),
       .5, ContactRung::fixed},
  };
}

void expect_named_queries() {
  for (const auto& q : named_queries()) {
    const ContactResult result = test_contact(q.query, Want::first_time);
    EXPECT_EQ(result.rung, q.rung) << q.name;
    EXPECT_TRUE(!q.time || result.time == (TimeEnclosure{*q.time, *q.time})) << q.name;
    for (const bool contact : {result.contact, test_contact(q.query, Want::yes_no).contact,
                               exact_contact(q.query).contact})
      EXPECT_EQ(contact, q.time.has_value()) << q.name;
  }
}

TEST(ElementaryTest, NamedQueriesAndTheRungThatDecides) {
  tests::on_small_stack(expect_named_queries);
}

// The vertex moves across an edge's line and then through the face, or past it, a 64th beside that
// line. The signs are sure at the ends of the step alone, and of short pieces within it.
TEST(ElementaryTest, TheFilterSettlesWhatPassesNearAnEdge) {
  tests::QueryDraw draw(7);
  int settled = 0, hits = 0;
  constexpr int rounds = 400;
  for (int i = 0; i < rounds; ++i) {
    const double way = .5 + draw.full() / 2, at_face = .5 + draw.full() / 2;
    const double beside = draw.between(0, 1) == 0 ? -0x1p-6 : 0x1p-6;
    const FourPoints query = vertex_moves({.4, beside - way * at_face, at_face},
                                          {.4, beside + way * (1 - at_face), at_face - 1});
    const ContactResult result = test_contact(query, Want::first_time);
    const auto truth = general_first_contact(query);
    ASSERT_EQ(result.contact, truth.has_value()) << i;
    EXPECT_EQ(result.time, truth.value_or(result.time)) << i;
    hits += result.contact;
    settled += result.rung == ContactRung::filter;
  }
  EXPECT_GT(hits, rounds / 3);
  EXPECT_GT(settled, rounds * 9 / 10);
}

TEST(ElementaryTest, IrrationalTimeIsEnclosedInAdjacentDoubles) {
  // The vertex sits in the plane z = 2 t^2 - 1 of edges that grow: contact where t^2 = 1/2.
  const FourPoints query = four_points(
      EdgeEdge{{MovingPoint{{-1, 0, -1}, {-1, 0, 1}}, MovingPoint{{1, 0, -1}, {1, 2, 1}}},
               {still({-.5, -1, 0}), still({-.5, 3, 0})}});
  const auto result = test_contact(query, Want::first_time);
  ASSERT_TRUE(result.contact);
  EXPECT_TRUE(result.time.lo == result.time.hi ||
              result.time.hi == std::nextafter(result.time.lo, 2.0));
  EXPECT_EQ(exact_contact(query).time, result.time);
}

// With s = 1 - 3t the vertex touches an edge of the face where s vanishes, and nowhere else: at a
// third, which is no double, and where dependencies of the four points have double zeros.
TEST(ElementaryTest, DoubleZerosAtAThird) {
  for (const double sign : {1., -1.}) {
    const FourPoints query = four_points(VertexFace{
        {{sign, 3, 1}, {-2 * sign, -6, -2}},
        {still({-2 * sign, -1, 0}), {{2 * sign, 1, 2}, {2 * sign, 1, -4}}, still({0, 0, 5})}});
    const ContactResult result = test_contact(query, Want::first_time);
    EXPECT_EQ(result.rung, ContactRung::unbounded);
    for (const bool contact :
         {result.contact, test_contact(query, Want::yes_no).contact, exact_contact(query).contact})
      EXPECT_TRUE(contact);
    const double below = std::nextafter(1. / 3, 0), third = 1. / 3;
    EXPECT_TRUE(result.time == (TimeEnclosure{below, third}) ||
                result.time == (TimeEnclosure{third, std::nextafter(third, 1)}))
        << result.time.lo << " " << result.time.hi;
  }
}

// An axis multiplied by a power of two changes neither contact nor time, nor who decides.
TEST(ElementaryTest, ExtremeMagnitudesAreBroughtIntoRange) {
  for (const double scale : {0x1p-1070, 0x1p-600, 0x1p600, 0x1p1020}) {
    FourPoints query = vertex_moves({.25, .25, 1}, {.25, .25, -1});
    for (auto& p : query.points) {
      for (std::size_t k = 0; k < 3; ++k) p.t0[k] *= scale, p.t1[k] *= scale;
    }
    const auto result = test_contact(query, Want::first_time);
    EXPECT_TRUE(result.contact) << scale;
    EXPECT_EQ(result.time, (TimeEnclosure{.5, .5})) << scale;
    EXPECT_EQ(result.rung, ContactRung::filter) << scale;
  }
}

TEST(ElementaryTest, CoplanarThroughoutIsRecognised) {
  EXPECT_TRUE(coplanar_throughout(vertex_moves({-1, .25, 0}, {1, .25, 0})));
  EXPECT_FALSE(coplanar_throughout(vertex_moves({-1, .25, 0}, {1, .25, 1e-300})));
}

// Whether a contact is surely later than a bound, against the exact first time.

struct Counts {
  int before = 0, by_doubles = 0, by_integers = 0;
};

// Asks about bounds around the first contact time and elsewhere. None at or after that time may be
// told to be before it.
void ask_about(const FourPoints& query, Counts& counts) {
  const auto contact = test_contact(query, Want::first_time);
  const auto& [lo, hi] = contact.time;
  for (const double until : {0., lo, hi, lo / 2, std::nextafter(lo, 0.), .25, .75, 1.}) {
    const bool is_later = !contact.contact || hi > until;
    const Later later = surely_later(query, until);
    EXPECT_TRUE(is_later || later == Later::no) << until << " of " << lo;
    counts.before += is_later;
    counts.by_doubles += later == Later::by_doubles;
    counts.by_integers += later == Later::by_integers;
  }
}

TEST(ContactUntil, NeverPassesAContact) {
  tests::QueryDraw draw(37);
  Counts fine, coarse, large;
  for (int i = 0; i < 20'000; ++i) {
    ask_about(draw.query([&] { return draw.full(); }), fine);
    ask_about(draw.query([&] { return static_cast<double>(draw.between(-3, 3)); }), coarse);
    ask_about(draw.query([&] { return std::ldexp(draw.full(), draw.between(0, 1) * 1024); }),
              large);
  }
  EXPECT_GT(fine.by_doubles, fine.before * 3 / 4);
  EXPECT_GT(coarse.by_integers, 100);
}

// A vertex in the plane of a face, on its way to it: the cubic vanishes, and only the order along
// the way tells. The bound is one double before the contact.
TEST(ContactUntil, InOnePlaneOrderTellsToTheLastBit) {
  tests::QueryDraw draw(37);
  for (int i = 0; i < 2'000; ++i) {
    FourPoints query = draw.query([&] { return draw.full(); });
    query.first_group = 1;
    for (std::size_t p = 0; p < 4; ++p) {
      query.points[p].t0[0] = query.points[p].t1[0] = 0;
      query.points[p].t0[2] += p == 0 ? 3 : 0;
      query.points[p].t1[2] = query.points[p].t0[2] + (p == 0 ? -3 : 0);
      query.points[p].t1[1] = query.points[p].t0[1];
    }
    // The way of the vertex ends in the face, which it enters at a corner first.
    query.points[1].t0[1] = query.points[1].t1[1] = query.points[0].t0[1];
    query.points[1].t0[2] = query.points[1].t1[2] = .75;
    query.points[0].t1[2] = 0;
    const auto contact = test_contact(query, Want::first_time);
    ASSERT_TRUE(contact.contact);
    EXPECT_EQ(surely_later(query, contact.time.hi), Later::no);
    EXPECT_NE(surely_later(query, std::nextafter(contact.time.lo, 0.)), Later::no);
  }
}

TEST(ContactUntil, TheGreatestDoublesAreNotOrderedByOverflow) {
  constexpr double most = std::numeric_limits<double>::max();
  const FourPoints query = four_points(VertexFace{
      {{0, 0, -most}, {0, 0, most}}, {still({-1, -1, 0}), still({2, -1, 0}), still({-1, 2, 0})}});
  EXPECT_EQ(surely_later(query, .75), Later::no);
  EXPECT_EQ(surely_later(query, .5), Later::no);
}

// In a thread with a small stack, over the queries that need most of it.

// p = (0,-a,0) -> (0,0,-e), face (0,0,0), (0,0,-c) -> 0, 0 -> (0,-e,0): all in one plane, with
// roots at 1 - e/a and 1 - e/c, both next to 1, and told apart by as many bits as a / e has. With
// two points in the first group they are two edges.
FourPoints roots_next_to_one(double a, double c, double e, int first_group) {
  return {{MovingPoint{{0, -a, 0}, {0, 0, -e}},
           still({0, 0, 0}),
           {{0, 0, -c}, {0, 0, 0}},
           {{0, 0, 0}, {0, -e, 0}}},
          first_group};
}

void expect_answered(const FourPoints& query) {
  const auto exact = exact_contact(query);
  const auto general = general_first_contact(query);
  EXPECT_EQ(general.has_value(), exact.contact);
  EXPECT_EQ(general.value_or(exact.time), exact.time);
  const ContactResult tested = test_contact(query, Want::first_time);
  EXPECT_EQ(tested.contact, exact.contact);
  EXPECT_TRUE(!exact.contact || tested.time == exact.time);
  test_contact(query, Want::yes_no);
  for (const auto arithmetic : all_values<Arithmetic>)
    test_contact(query, Want::first_time, arithmetic);
}

TEST(ContactStack, RootsThatManyBitsTellApart) {
  tests::expect_enough_stack("roots next to 1", [] {
    for (int big = 20; big <= 1020; big += 100) {
      for (int small = -20; small >= -1070; small -= 150) {
        const double a = std::ldexp(1, big), c = std::ldexp(5, big / 2), e = std::ldexp(1, small);
        for (const int first_group : {1, 2})
          expect_answered(roots_next_to_one(a, c, e, first_group));
      }
    }
  });
}

TEST(ContactStack, ExponentsOverAllDoubles) {
  tests::expect_enough_stack("exponents over all doubles", [] {
    std::mt19937_64 engine(20117);
    const auto below = [&engine](int n) { return static_cast<int>(engine() % std::uint64_t(n)); };
    for (int i = 0; i < 600; ++i) {
      FourPoints q;
      q.first_group = 1 + i % 2;
      const bool flat = i % 3 == 0;
      for (auto& p : q.points) {
        for (double* end : {p.t0.data(), p.t1.data()}) {
          for (int k = 0; k < 3; ++k)
            end[k] = flat && k == 0 ? 0 : std::ldexp(below(5) - 2, below(2097) - 1074);
        }
      }
      expect_answered(q);
    }
  });
}

}  // namespace
}  // namespace assay::detector
