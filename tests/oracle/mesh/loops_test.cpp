#include "oracle/mesh/mesh_features.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Triangles, test::triangles;
using Edges = std::vector<DirectedEdge>;
using Loops = std::vector<Loop>;

const Triangles no_triangles(0, 3);

TEST(Loops, ClosedMeshHasNone) {
  const Triangles f = test::turning_tetrahedron().f;
  EXPECT_TRUE(unmatched_edges(f).empty());
  EXPECT_TRUE(boundary_loops(f).empty());
  EXPECT_TRUE(closes(f, no_triangles));
  EXPECT_TRUE(closes(no_triangles, no_triangles));
}

TEST(Loops, OneTriangle) {
  const Triangles f = triangles({{4, 2, 7}});
  EXPECT_EQ(unmatched_edges(f), (Edges{{2, 7}, {4, 2}, {7, 4}}));
  EXPECT_EQ(boundary_loops(f), (Loops{{2, 7, 4}}));
  EXPECT_FALSE(closes(f, no_triangles));
  const Triangles ghosts = ghost_triangles(boundary_loops(f), 8);
  EXPECT_EQ(ghosts, triangles({{7, 2, 8}, {4, 7, 8}, {2, 4, 8}}));
  EXPECT_TRUE(closes(f, ghosts));
}

TEST(Loops, FourTrianglesAtAMatchedEdge) {
  // Two tetrahedra that share the edge 01.
  EXPECT_TRUE(closes(
      triangles(
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}}),
      no_triangles));
}

TEST(Loops, EdgeUsedTwiceMoreIsUnmatchedTwice) {
  const Triangles f = triangles({{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(unmatched_edges(f), (Edges{{0, 1}, {0, 1}, {1, 2}, {1, 3}, {2, 0}, {3, 0}}));
  // One walk, through its start: 0 1 2 0 1 3.
  EXPECT_EQ(boundary_loops(f), (Loops{{0, 1, 2, 0, 1, 3}}));
  EXPECT_TRUE(closes(f, ghost_triangles(boundary_loops(f), 4)));
}

TEST(Loops, WalkGoesOnThroughRepeatedVertices) {
  // A bow tie: two triangles with one vertex in common.
  const Triangles f = triangles({{0, 1, 2}, {1, 3, 4}});
  EXPECT_EQ(boundary_loops(f), (Loops{{0, 1, 2}, {1, 3, 4}}));  // 1 leads to 2, the lower one
  EXPECT_EQ(boundary_loops(triangles({{0, 1, 4}, {1, 2, 3}})), (Loops{{0, 1, 2, 3, 1, 4}}));
}

TEST(Loops, FlippedNeighbourIsUnmatchedTwice) {
  const Triangles f = triangles({{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  EXPECT_EQ(unmatched_edges(f).size(), 7u);
  EXPECT_TRUE(closes(f, ghost_triangles(boundary_loops(f), 5)));
}

TEST(Loops, RepeatedIndexMatchesItself) {
  EXPECT_TRUE(closes(triangles({{3, 3, 1}}), no_triangles));
  EXPECT_TRUE(unmatched_edges(triangles({{3, 3, 1}, {2, 2, 2}})).empty());
}

TEST(Loops, AnyWalkThatUsesEachEdgeOnceCloses) {
  const Triangles f = triangles({{0, 1, 4}, {1, 2, 3}});
  EXPECT_TRUE(closes(f, ghost_triangles({{0, 1, 4}, {1, 2, 3}}, 5)));
}

TEST(Loops, WrongGhostsDoNotClose) {
  const Triangles f = triangles({{0, 1, 2}});
  EXPECT_FALSE(closes(f, triangles({{1, 0, 3}, {2, 1, 3}})));             // one missing
  EXPECT_FALSE(closes(f, triangles({{0, 1, 3}, {1, 2, 3}, {2, 0, 3}})));  // turned over
  EXPECT_FALSE(closes(f, triangles({{2, 1, 0}})));                        // a cycle, but no fan
  // Two apexes that are not those of closed walks.
  EXPECT_FALSE(closes(f, triangles({{1, 0, 3}, {2, 1, 3}, {0, 2, 4}})));
  // A closed mesh with ghosts of their own.
  EXPECT_FALSE(closes(test::turning_tetrahedron().f, triangles({{1, 0, 4}, {0, 1, 4}})));
}

// "Any triangle set can be closed": repeated, flipped, duplicate triangles too.
TEST(Loops, L12_GhostsCloseAnyTriangles) {
  test::Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const int vertices = 3 + random.below(6), count = random.below(12);
    const Triangles f = any_triangles(random, vertices, count);
    const auto loops = boundary_loops(f);
    std::size_t edges = 0;
    for (const Loop& loop : loops) edges += loop.size();
    EXPECT_EQ(edges, unmatched_edges(f).size());
    EXPECT_TRUE(closes(f, ghost_triangles(loops, vertices)));
  }
}

}  // namespace
}  // namespace assay::oracle
