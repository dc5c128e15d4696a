// Laws of contacts on random queries of every kind of coordinates; fixed seeds.
#include <cfenv>

#include "oracle/processor_state.h"
#include "oracle/query/contact.h"
#include "oracle/query/rungs.h"
#include "oracle/query/times/times.h"
#include "tests/oracle/random_points.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace assay::oracle {
namespace {

using detector::EdgeEdge, detector::MovingPoint, detector::TimeEnclosure, detector::VertexFace,
    detector::Want, test::Coordinates, test::Random, test::rest;

constexpr int queries_per_kind = tests::usual(300);

ContactAnswer judge(const FourPoints& query) { return contact_of(query, Want::first_time); }

template <class Law>
void for_random_queries(std::uint64_t seed, const Law& law) {
  Random random(seed);
  for (int kind = 0; kind < test::coordinate_kinds; ++kind) {
    for (int i = 0; i < queries_per_kind; ++i) {
      FourPoints query;
      query.first_group = 1 + i % 2;
      for (MovingPoint& p : query.points)
        p = test::random_point(random, static_cast<Coordinates>(kind));
      if (random.below(6) == 0) query.points[3] = query.points[random.below(3)];
      law(query);
      ASSERT_FALSE(testing::Test::HasFailure()) << kind << " query " << i;
    }
  }
}

TEST(ContactLaws, RungsAgree) {
  for_random_queries(11, [](const FourPoints& query) {
    ContactPolynomials polynomials(query);
    const ExactAnswer full = algebraic_answer(polynomials, Want::first_time);
    EXPECT_FALSE(separated_by_axis(query) && full.contact);
    const ExactAnswer closed = quadratic_answer(polynomials, Want::first_time);
    EXPECT_EQ(closed.contact, full.contact);
    EXPECT_EQ(closed.first, full.first);
    for (const Want want : {Want::yes_no, Want::first_time}) {
      const IntervalAnswer quick = interval_answer(query, want);
      if (quick.decision == detector::Decision::open) continue;
      EXPECT_EQ(quick.decision == detector::Decision::yes, full.contact);
      if (!full.contact || want == Want::yes_no) continue;
      EXPECT_EQ(simple_zero_time(polynomials.coplanarity(), quick.s, quick.e), full.first);
    }
  });
}

TEST(ContactLaws, WantDoesNotChangeTheAnswer) {
  for_random_queries(12, [](const FourPoints& query) {
    const ContactAnswer timed = judge(query);
    EXPECT_EQ(contact_of(query, Want::yes_no).contact, timed.contact);
    if (!timed.contact) return;
    EXPECT_GE(timed.first.lo, 0);
    EXPECT_LE(timed.first.hi, 1);
    EXPECT_TRUE(timed.first.lo == timed.first.hi ||
                std::nextafter(timed.first.lo, 2) == timed.first.hi);
  });
}

TEST(ContactLaws, TimeReversalKeepsTheAnswer) {
  for_random_queries(13, [](const FourPoints& query) {
    FourPoints back = query;
    for (MovingPoint& p : back.points) std::swap(p.t0, p.t1);
    const ContactAnswer forward = judge(query), reversed = judge(back);
    EXPECT_EQ(forward.contact, reversed.contact);
    if (!forward.contact) return;
    // The reversed first time is 1 - (last time), and the last is not before the first.
    EXPECT_LE(forward.first.lo + reversed.first.lo, 1);
  });
}

TEST(ContactLaws, OrderOfPointsDoesNotMatter) {
  for_random_queries(14, [](const FourPoints& query) {
    const ContactAnswer expected = judge(query);
    auto same = [&](const FourPoints& other) {
      const ContactAnswer answer = judge(other);
      EXPECT_EQ(answer.contact, expected.contact);
      EXPECT_EQ(answer.first, expected.first);
    };
    FourPoints other = query;
    std::swap(other.points[2], other.points[3]);
    same(other);
    if (query.first_group == 2) {
      std::swap(other.points[0], other.points[1]);
      same(other);
      std::swap(other.points[0], other.points[2]);
      std::swap(other.points[1], other.points[3]);
      same(other);
    } else {
      std::swap(other.points[1], other.points[2]);
      same(other);
    }
  });
}

TEST(ContactLaws, AxesAreAlike) {
  for_random_queries(15, [](const FourPoints& query) {
    FourPoints other = query;
    for (MovingPoint& p : other.points)
      p = {{p.t0[1], p.t0[2], -p.t0[0]}, {p.t1[1], p.t1[2], -p.t1[0]}};
    const ContactAnswer expected = judge(query), answer = judge(other);
    EXPECT_EQ(answer.contact, expected.contact);
    EXPECT_EQ(answer.first, expected.first);
  });
}

TEST(ContactLaws, PowersOfTwoDoNotChangeTheTime) {
  for_random_queries(16, [](const FourPoints& query) {
    const ContactAnswer expected = judge(query);
    for (const int exponent : {-900, -60, 7, 900}) {
      FourPoints other = query;
      for (MovingPoint& p : other.points) {
        for (int k = 0; k < 3; ++k) {
          p.t0[k] = std::ldexp(p.t0[k], exponent);
          p.t1[k] = std::ldexp(p.t1[k], exponent);
        }
      }
      const ContactAnswer answer = judge(other);
      EXPECT_EQ(answer.contact, expected.contact) << exponent;
      EXPECT_EQ(answer.first, expected.first) << exponent;
    }
  });
}

TEST(ContactLaws, AContactOfAFaceIsAContactOfALargerFace) {
  // Doubling a face about its first corner keeps every point of it; the time can only be earlier.
  for_random_queries(17, [](const FourPoints& query) {
    if (query.first_group != 1) return;
    const ContactAnswer small = judge(query);
    if (!small.contact) return;
    FourPoints larger = query;
    for (auto end : {&MovingPoint::t0, &MovingPoint::t1}) {
      for (int i = 2; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) {
          // Exact: twice a double is one, and the differences used here are when on a grid.
          double& x = (larger.points[i].*end)[k];
          const double corner = (query.points[1].*end)[k];
          const double doubled = 2 * (x - corner) + corner;
          if ((doubled - corner) / 2 + corner != x || std::fabs(x) > 4 || x != std::floor(x))
            return;
          x = doubled;
        }
      }
    }
    const ContactAnswer large = judge(larger);
    EXPECT_TRUE(large.contact);
    EXPECT_LE(large.first.lo, small.first.lo);
  });
}

// Every finite double is a valid coordinate: denormals, the largest, and all mixed.

constexpr double least_double = std::numeric_limits<double>::denorm_min();
constexpr double greatest_double = std::numeric_limits<double>::max();

VertexFace through_face(double size, double from, double to) {
  return {{{0, 0, from}, {0, 0, to}},
          {rest({-size, -size, 0}), rest({size, -size, 0}), rest({0, size, 0})}};
}

TEST(ExtremeNumbers, LeastAndGreatestDoubles) {
  const auto expect = [](double size, double from, double to, const TimeEnclosure& first) {
    const auto hit = vertex_face_contact(through_face(size, from, to), Want::first_time);
    EXPECT_TRUE(hit.contact) << from << " " << to;
    EXPECT_EQ(hit.first, first) << from << " " << to;
    return hit.rung;
  };
  expect(least_double, least_double, -least_double, {0.5, 0.5});
  EXPECT_FALSE(vertex_face_contact(through_face(least_double, 2 * least_double, least_double),
                                   Want::first_time)
                   .contact);
  const Rung rung = expect(greatest_double, greatest_double, -greatest_double, {0.5, 0.5});
  EXPECT_EQ(static_cast<int>(rung), static_cast<int>(Rung::quadratic));
  // The crossing is at least_double / (least_double + greatest_double). That is far below the
  // least double, so the time is between 0 and it. From the other side it is within 2^-2000 of 1.
  expect(1, least_double, -greatest_double, {0, least_double});
  expect(1, greatest_double, -least_double, {std::nextafter(1.0, 0.0), 1});
}

TEST(ExtremeNumbers, OneDenormalDecides) {
  // Passes the corner (0, size) of the face at a distance of the least denormal, or touches it.
  VertexFace touch = through_face(1, 1, -1);
  touch.vertex = {{0, 1, 1}, {0, 1, -1}};
  EXPECT_TRUE(vertex_face_contact(touch, Want::yes_no).contact);
  touch.vertex = {{least_double, 1, 1}, {least_double, 1, -1}};
  EXPECT_FALSE(vertex_face_contact(touch, Want::yes_no).contact);
  touch.vertex = {{least_double, 1, 1}, {-least_double, 1, -1}};
  EXPECT_TRUE(vertex_face_contact(touch, Want::yes_no).contact);
}

TEST(ExtremeNumbers, RandomExponentsKeepTheLaws) {
  Random random(21);
  for (int i = 0; i < 60; ++i) {
    detector::EdgeEdge q;
    for (MovingPoint* p : {&q.a[0], &q.a[1], &q.b[0], &q.b[1]}) {
      for (int k = 0; k < 3; ++k) {
        const int range = i % 2 == 0 ? 1000 : 300;
        p->t0[k] = std::ldexp(random.unit(), random.below(2 * range + 1) - range);
        p->t1[k] = std::ldexp(random.unit(), random.below(2 * range + 1) - range);
      }
    }
    const ContactAnswer answer = edge_edge_contact(q, Want::first_time);
    const ContactAnswer swapped = edge_edge_contact({q.b, {q.a[1], q.a[0]}}, Want::first_time);
    EXPECT_EQ(swapped.contact, answer.contact) << i;
    EXPECT_EQ(swapped.first, answer.first) << i;
    for (MovingPoint* p : {&q.a[0], &q.a[1], &q.b[0], &q.b[1]}) std::swap(p->t0, p->t1);
    EXPECT_EQ(edge_edge_contact(q, Want::yes_no).contact, answer.contact) << i;
  }
}

TEST(ProcessorState, IsExactAndStaysSo) {
  EXPECT_TRUE(processor_state_is_exact());
  (void)vertex_face_contact(through_face(1, 1, -2), Want::first_time);
  (void)vertex_face_contact(through_face(greatest_double, 1, -2), Want::first_time);
  EXPECT_TRUE(processor_state_is_exact());
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(ProcessorState, OtherRoundingIsSeen) {
  std::fesetround(FE_UPWARD);
  const bool exact = processor_state_is_exact();
  std::fesetround(FE_TONEAREST);
  EXPECT_FALSE(exact);
}

#if defined(__SSE2__)
TEST(ProcessorState, FlushedDenormalsAreSeen) {
  const unsigned before = _mm_getcsr();
  constexpr unsigned flush_to_zero = 1U << 15, denormals_are_zero = 1U << 6;
  _mm_setcsr(before | flush_to_zero);
  const bool flushed = processor_state_is_exact();
  _mm_setcsr(before | denormals_are_zero);
  const bool read_as_zero = processor_state_is_exact();
  _mm_setcsr(before);
  EXPECT_FALSE(flushed);
  EXPECT_FALSE(read_as_zero);
}
#endif

TEST(ProcessorStateDeathTest, NoAnswerInAnotherState) {
  EXPECT_DEATH(
      {
        std::fesetround(FE_DOWNWARD);
        (void)vertex_face_contact(through_face(1, 1, -1), Want::yes_no);
      },
      "round to nearest");
}

}  // namespace
}  // namespace assay::oracle
