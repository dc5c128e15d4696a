// How the pair rule directs a search, what a stopped search does, and which contacts a search
// lists.
#include "detector/search/candidate_search.h"

#include "detector/step/stages.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::detector {
namespace {

// The share of neighbours that the pair rule asks for, as the cost model estimates it.

// A mesh of few edges is asked edge by edge: one triangle of the octahedron, seen negative among
// positive ones, is asked for at three of the twelve edges.
TEST(AskedShare, OfASmallMeshIsExact) {
  const Topology mesh = make_topology(tests::octahedron(), 6);
  const Positions x = tests::octahedron_positions(1);
  BoundingVolumeTree tree(mesh, x);
  tree.refit(mesh, {x, x});
  const Stages stages = standard_stages({Culling::view_point});
  SearchMemory memory(tree);
  PacedStop never(never_stops);
  const auto mesh_search = stages.pair_search->prepare(mesh, tree, never);
  CandidateSearch search({*stages.pair_rule, *stages.marking, *mesh_search, *stages.elementary},
                         mesh, tree, memory, {x, x}, never);
  for (std::size_t negative = 0; negative < mesh.triangles.size(); ++negative) {
    std::vector<TriangleType> types(mesh.triangles.size(), TriangleType::positive);
    types[negative] = TriangleType::negative;
    ASSERT_TRUE(search.mark(types));
    EXPECT_EQ(search.asked_share(), 3. / 12) << negative;
  }
  ASSERT_TRUE(search.mark(std::vector(mesh.triangles.size(), TriangleType::positive)));
  EXPECT_EQ(search.asked_share(), 0);
}

// A search that is stopped while it brings its memory to new types leaves nothing of that behind.

class StoppedMarking : public testing::Test {
 protected:
  struct Found {
    std::vector<TrianglePair> pairs;
    std::uint64_t tests = 0;
    bool operator==(const Found&) const = default;
  };

  StoppedMarking() { search_->fit(tree_, mesh_.topology, mesh_.motion(), never_); }

  CandidateSearch search(SearchMemory& memory, const StopFunction& stop) const {
    return {stages_, mesh_.topology, tree_, memory, mesh_.motion(), PacedStop(stop)};
  }
  Found found(SearchMemory& memory, std::span<const TriangleType> types) const {
    auto whole = search(memory, never_stops);
    EXPECT_TRUE(whole.mark(types) && whole.collect());
    Found found;
    for (const auto& contact : whole.take_contacts()) found.pairs.push_back(contact.pair);
    found.tests = whole.narrow_counts().elementary_tests;
    return found;
  }

  tests::SearchMeshes random_{11};
  const tests::MovingMesh mesh_ = random_.sheets(2, 100, false);  // 40,000 triangles
  const Stages standard_ = standard_stages({Culling::view_point});
  BoundingVolumeTree tree_{mesh_.topology, mesh_.x_t0};
  PacedStop never_{never_stops};
  const std::unique_ptr<MeshSearch> search_ =
      standard_.pair_search->prepare(mesh_.topology, tree_, never_);
  const SearchStages stages_{*standard_.pair_rule, *standard_.marking, *search_,
                             *standard_.elementary};
};

TEST_F(StoppedMarking, IsForgotten) {
  std::vector<TriangleType> types(mesh_.topology.triangles.size());
  for (auto& type : types) type = random_.below(30) ? TriangleType::negative : TriangleType::zero;
  SearchMemory fresh(tree_);
  const Found expected = found(fresh, types);
  ASSERT_GT(expected.pairs.size(), 0u);
  int stopped = 0;
  for (std::uint64_t n = 1; n < 4; ++n) {
    SearchMemory memory(tree_);
    std::uint64_t calls = 0;
    const StopFunction stop = [&] { return ++calls == n; };
    stopped += !search(memory, stop).mark(types);
    EXPECT_LE(calls, n);
    EXPECT_EQ(found(memory, types), expected) << n;
  }
  EXPECT_GE(stopped, 2);
}

// The list of contacts against a plain one, and what it takes.

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
    std::vector<TrianglePair> pairs;
    for (int i = 0; i < 40'000; ++i) {
      const auto c = drawn_contact(draw, triangles);
      contacts.add(c);
      const auto [place, is_new] = first.try_emplace(c.pair, order_of(c));
      if (!is_new) place->second = std::min(place->second, order_of(c));
      if (i % 9'999 != 0) continue;
      for (const auto& pair : contacts.take_new_pairs()) pairs.push_back(pair);
      EXPECT_EQ(pairs.size(), first.size());
    }
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end()) << "each is new once";
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
  std::uint64_t calls = 0, stopped = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::size_t before = contacts.bytes();
    const std::uint64_t calls_before = calls;
    bool has_stopped = false;
    const StopFunction stop = [&] {
      const bool stops = ++calls % 3 == 0 && !has_stopped;
      has_stopped = has_stopped || stops;
      return stops;
    };
    while (contacts.is_nearly_full() && !contacts.make_room(stop)) {
      ++stopped;
      EXPECT_LT(contacts.bytes(), before + before / 2) << "what was begun is given back";
    }
    if (contacts.bytes() > before) {
      constexpr std::size_t at_once = std::size_t{1} << 20;
      EXPECT_GE((calls - calls_before) * at_once, contacts.bytes() - before);
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
