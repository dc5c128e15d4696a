// Every finite double is a valid coordinate: denormals, the largest, and all mixed.
#include <cfenv>

#include "oracle/processor_state.h"
#include "oracle/query/contact.h"
#include "tests/oracle/random_points.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace assay::oracle {
namespace {

using detector::MovingPoint, detector::VertexFace, detector::Want, test::Random;

constexpr double least_double = std::numeric_limits<double>::denorm_min();
constexpr double greatest_double = std::numeric_limits<double>::max();

VertexFace through_face(double size, double from, double to) {
  auto rest = [](double x, double y) { return MovingPoint{{x, y, 0}, {x, y, 0}}; };
  return {{{0, 0, from}, {0, 0, to}}, {rest(-size, -size), rest(size, -size), rest(0, size)}};
}

TEST(ExtremeNumbers, LeastDenormals) {
  const ContactAnswer hit = vertex_face_contact(
      through_face(least_double, least_double, -least_double), Want::first_time);
  EXPECT_TRUE(hit.contact);
  EXPECT_EQ(hit.first, (detector::TimeEnclosure{0.5, 0.5}));
  EXPECT_FALSE(vertex_face_contact(through_face(least_double, 2 * least_double, least_double),
                                   Want::first_time)
                   .contact);
}

TEST(ExtremeNumbers, GreatestDoubles) {
  const ContactAnswer hit = vertex_face_contact(
      through_face(greatest_double, greatest_double, -greatest_double), Want::first_time);
  EXPECT_TRUE(hit.contact);
  EXPECT_EQ(hit.first, (detector::TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(static_cast<int>(hit.rung), static_cast<int>(Rung::quadratic));
}

TEST(ExtremeNumbers, DenormalBesideGreatest) {
  // The crossing is at least_double / (least_double + greatest_double). That is far below the
  // least double, so the time is between 0 and it.
  const ContactAnswer hit =
      vertex_face_contact(through_face(1, least_double, -greatest_double), Want::first_time);
  EXPECT_TRUE(hit.contact);
  EXPECT_EQ(hit.first, (detector::TimeEnclosure{0, least_double}));
  // And from the other side: within 2^-2000 of 1.
  const ContactAnswer late =
      vertex_face_contact(through_face(1, greatest_double, -least_double), Want::first_time);
  EXPECT_TRUE(late.contact);
  EXPECT_EQ(late.first, (detector::TimeEnclosure{std::nextafter(1.0, 0.0), 1}));
}

TEST(ExtremeNumbers, OneDenormalDecides) {
  // Passes the corner (0, size) of the face at a distance of the least denormal, or touches it.
  VertexFace touch = through_face(1, 1, -1);
  touch.vertex = {{0, 1, 1}, {0, 1, -1}};
  EXPECT_TRUE(vertex_face_contact(touch, Want::yes_no).contact);
  touch.vertex = {{least_double, 1, 1}, {least_double, 1, -1}};
  const ContactAnswer miss = vertex_face_contact(touch, Want::yes_no);
  EXPECT_FALSE(miss.contact);
  touch.vertex = {{least_double, 1, 1}, {-least_double, 1, -1}};
  EXPECT_TRUE(vertex_face_contact(touch, Want::yes_no).contact);
}

TEST(ExtremeNumbers, RandomExponentsKeepTheLaws) {
  Random random(21);
  int contacts = 0;
  constexpr int query_count = 60;
  for (int i = 0; i < query_count; ++i) {
    detector::EdgeEdge q;
    for (MovingPoint* p : {&q.a[0], &q.a[1], &q.b[0], &q.b[1]}) {
      for (int k = 0; k < 3; ++k) {
        const int range = i % 2 == 0 ? 1000 : 300;
        p->t0[k] = std::ldexp(random.unit(), random.below(2 * range + 1) - range);
        p->t1[k] = std::ldexp(random.unit(), random.below(2 * range + 1) - range);
      }
    }
    const ContactAnswer answer = edge_edge_contact(q, Want::first_time);
    contacts += answer.contact;
    const ContactAnswer swapped = edge_edge_contact({q.b, {q.a[1], q.a[0]}}, Want::first_time);
    EXPECT_EQ(swapped.contact, answer.contact) << i;
    EXPECT_EQ(swapped.first, answer.first) << i;
    for (MovingPoint* p : {&q.a[0], &q.a[1], &q.b[0], &q.b[1]}) std::swap(p->t0, p->t1);
    EXPECT_EQ(edge_edge_contact(q, Want::yes_no).contact, answer.contact) << i;
  }
  std::printf("%d queries, %d in contact\n", query_count, contacts);
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
