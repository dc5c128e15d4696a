// Whether a contact is surely later than a bound, against the exact first time.

#include <cmath>

#include "detector/contact/elementary.h"
#include "tests/detector/contact/query_draw.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

;

struct Told {
  int before = 0, by_doubles = 0, by_integers = 0;
};

// Asks about bounds around the first contact time and elsewhere. None at or after that time may be
// told to be before it.
void ask_about(const FourPoints& query, Told& told) {
  const auto contact = test_contact(query, Want::first_time);
  const auto& [lo, hi] = contact.time;
  for (const double until : {0., lo, hi, lo / 2, std::nextafter(lo, 0.), .25, .75, 1.}) {
    const bool is_later = !contact.contact || hi > until;
    const Later later = surely_later(query, until);
    if (!is_later) {
      EXPECT_EQ(later, Later::no) << until << " of " << lo;
    } else {
      ++told.before;
      told.by_doubles += later == Later::by_doubles;
      told.by_integers += later == Later::by_integers;
    }
  }
}

TEST(ContactUntil, NeverPassesAContact) {
  tests::QueryDraw draw(37);
  Told fine, coarse, large;
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
  int contacts = 0;
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
    ++contacts;
    EXPECT_EQ(surely_later(query, contact.time.hi), Later::no);
    EXPECT_NE(surely_later(query, std::nextafter(contact.time.lo, 0.)), Later::no);
  }
  EXPECT_EQ(contacts, 2'000);
}

TEST(ContactUntil, TheGreatestDoublesAreNotOrderedByOverflow) {
  constexpr double most = std::numeric_limits<double>::max();
  FourPoints query;
  query.first_group = 1;
  query.points[0] = {{0, 0, -most}, {0, 0, most}};
  query.points[1] = {{-1, -1, 0}, {-1, -1, 0}};
  query.points[2] = {{2, -1, 0}, {2, -1, 0}};
  query.points[3] = {{-1, 2, 0}, {-1, 2, 0}};
  EXPECT_EQ(surely_later(query, .75), Later::no);
  EXPECT_EQ(surely_later(query, .5), Later::no);
}

}  // namespace
}  // namespace assay::detector
