// What the pair rule asks of a search, and a search that is stopped.
#include "detector/search/candidate_search.h"

#include "detector/step/stages.h"
#include "tests/detector/points.h"
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
  SearchMemory memory(mesh, tree);
  PacedStop never(never_stops);
  const auto mesh_search = stages.pair_search->prepare(mesh, tree, never);
  CandidateSearch search({*stages.pair_rule, *stages.marking, *mesh_search, *stages.elementary},
                         mesh, tree, memory, {x, x}, never_stops);
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

  StoppedMarking() { search_->fit(tree_, mesh_.topology, {mesh_.x_t0, mesh_.x_t1}, never_); }

  CandidateSearch search(SearchMemory& memory, const StopFunction& stop) const {
    return {stages_, mesh_.topology, tree_, memory, {mesh_.x_t0, mesh_.x_t1}, stop};
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
  SearchMemory fresh(mesh_.topology, tree_);
  const Found expected = found(fresh, types);
  ASSERT_GT(expected.pairs.size(), 0u);
  int stopped = 0;
  for (std::uint64_t n = 1; n < 4; ++n) {
    SearchMemory memory(mesh_.topology, tree_);
    std::uint64_t asked = 0;
    const StopFunction stop = [&] { return ++asked == n; };
    stopped += !search(memory, stop).mark(types);
    EXPECT_LE(asked, n);
    EXPECT_EQ(found(memory, types), expected) << n;
  }
  EXPECT_GE(stopped, 2);
}

}  // namespace
}  // namespace assay::detector
