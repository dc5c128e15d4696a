// The list of contacts against a plain one, and what it takes.
#include "detector/search/feature_contacts.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

using ContactOrder = std::tuple<double, int, std::array<std::int32_t, 5>>;

PairContact drawn_contact(std::mt19937& draw, int triangles) {
  const auto below = [&](int n) { return static_cast<std::int32_t>(draw() % unsigned(n)); };
  PairContact c;
  c.pair.a = below(triangles);
  c.pair.b = c.pair.a + 1 + below(triangles);
  c.time.lo = c.time.hi = .25 * below(5);
  c.feature.kind = static_cast<FeatureKind>(below(3));
  c.feature.vertices[0] = below(3);
  return c;
}

ContactOrder order_of(const PairContact& c) {
  return {c.time.lo, static_cast<int>(c.feature.kind), c.feature.vertices};
}

TEST(PairContacts, KeepsTheFirstContactOfEachPair) {
  for (const int triangles : {1, 30, 300}) {
    std::mt19937 draw(7);
    PairContacts contacts;
    std::map<TrianglePair, ContactOrder> first;
    std::vector<TrianglePair> seen;
    for (int i = 0; i < 40'000; ++i) {
      const auto c = drawn_contact(draw, triangles);
      contacts.add(c);
      const auto [place, is_new] = first.try_emplace(c.pair, order_of(c));
      if (!is_new) place->second = std::min(place->second, order_of(c));
      if (i % 9'999 != 0) continue;
      for (const auto& pair : contacts.take_new_pairs()) seen.push_back(pair);
      EXPECT_EQ(seen.size(), first.size());
    }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end()) << "each is new once";
    const auto all = contacts.take();
    ASSERT_EQ(all.size(), first.size());
    auto expected = first.begin();
    for (const auto& c : all) {
      EXPECT_EQ(c.pair, expected->first);
      EXPECT_EQ(order_of(c), expected->second);
      ++expected;
    }
    EXPECT_TRUE(contacts.take().empty());
  }
}

// 21 contacts of each of 100,000 pairs: a list of them all, or a list a contact, took 2.2 KB a
// pair.
TEST(PairContacts, TakeLittleBesideTheResult) {
  constexpr int pairs = 100'000, contacts_of_pair = 21;
  PairContacts contacts;
  std::size_t most = 0;
  for (int i = 0; i < pairs; ++i) {
    for (int k = 0; k < contacts_of_pair; ++k) {
      PairContact c;
      c.pair = {i % 1000, 1000 + i / 1000};
      c.feature.vertices[0] = k;
      const std::size_t before = contacts.bytes();
      contacts.add(c);
      // Old and new list, while the one is brought to the other.
      most = std::max(most, contacts.bytes() + (contacts.bytes() > before ? before : 0));
    }
  }
  const std::size_t result = contacts.take().size() * sizeof(PairContact);
  EXPECT_EQ(result, pairs * sizeof(PairContact));
  EXPECT_LE(most, result + 100 * pairs);
}

// A list that grows is copied, which a limit of memory has to see before it is done.
TEST(PairContacts, AskWhileTheyGrowAndLoseNothing) {
  constexpr std::int32_t count = 200'000;
  PairContacts contacts;
  std::uint64_t asked = 0, stopped = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::size_t before = contacts.bytes();
    const std::uint64_t asked_before = asked;
    bool has_stopped = false;
    const StopFunction stop = [&] {
      const bool stops = ++asked % 3 == 0 && !has_stopped;
      has_stopped = has_stopped || stops;
      return stops;
    };
    while (contacts.is_nearly_full() && !contacts.make_room(stop)) {
      ++stopped;
      EXPECT_LT(contacts.bytes(), before + before / 2) << "what was begun is given back";
    }
    if (contacts.bytes() > before) {
      constexpr std::size_t at_once = std::size_t{1} << 20;
      EXPECT_GE((asked - asked_before) * at_once, contacts.bytes() - before);
    }
    PairContact c;
    c.pair = {count - i, count - i + 1};
    contacts.add(c);
  }
  EXPECT_GT(stopped, 0u);
  const auto all = contacts.take();
  ASSERT_EQ(all.size(), std::size_t{count});
  for (std::int32_t i = 0; i < count; ++i) ASSERT_EQ(all[at(i)].pair.a, i + 1);
}

}  // namespace
}  // namespace assay::detector
