// The share of neighbours that the pair rule asks for, as the cost model estimates it.
#include <gtest/gtest.h>

#include "detector/search/candidate_search.h"
#include "detector/step/stages.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

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

}  // namespace
}  // namespace assay::detector
