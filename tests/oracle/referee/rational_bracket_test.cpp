// Contacts that begin and end between neighbouring doubles, and what is no proof.
#include "oracle/referee/rational_bracket.h"

#include "oracle/query/contact.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::EdgeEdge, detector::VertexFace;

// A vertex over a face whose plane turns: z = t x, raised by `above` at two corners. The vertex
// moves along the tangent of its path in that plane at t = 1/2, so that F has two zeros there,
// which are sqrt(above) away from 1/2, or none where `above` is negative.
VertexFace grazing(double above, double y = .2) {
  return {{{.25, y, -.125}, {.75, y, .625}},
          {{{{0, 0, -above}, {0, 0, -above}},
            {{0, 1, -above}, {0, 1, -above}},
            {{1, 0, 0}, {1, 0, 1}}}}};
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
  const detector::Point a = {0, 0, 0}, b = {4, 0, 0}, c = {0, 4, 0};
  const VertexFace at_half = {{{1, 1, 1}, {1, 1, -1}}, {{{a, a}, {b, b}, {c, c}}}};
  EXPECT_TRUE(meet_between(at_half, .25, .75));
  EXPECT_TRUE(meet_between(at_half, 0, 1));
  EXPECT_FALSE(meet_between(at_half, .25, .5));
  EXPECT_FALSE(meet_between(at_half, .5, 1));
}

template <class Query>
void expect_what_the_oracle_says(const Query& query, const ContactAnswer& answer, int& contacts) {
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
    const VertexFace face = {point(), {point(), point(), point()}};
    expect_what_the_oracle_says(face, vertex_face_contact(face, detector::Want::first_time),
                                contacts);
    const EdgeEdge edges = {{point(), point()}, {point(), point()}};
    expect_what_the_oracle_says(edges, edge_edge_contact(edges, detector::Want::first_time),
                                contacts);
  }
  EXPECT_GT(contacts, 40);
}

}  // namespace
}  // namespace assay::oracle
