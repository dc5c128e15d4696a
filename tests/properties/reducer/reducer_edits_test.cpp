// Size, edits and sphere meshes of the reducer.
#include "properties/reducer/case_edits.h"
#include "properties/reducer/mesh_size.h"
#include "properties/reducer/passes/passes.h"
#include "tests/properties/reducer/resting_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace toys;

TEST(MeshSize, StepsThenTrianglesThenVerticesThenMotionThenNumbers) {
  const Case small = tetrahedron();
  EXPECT_LT(size_of(small), size_of(octahedron()));
  EXPECT_LT(size_of(octahedron(2)), size_of(octahedron(3)));
  Case moving = small;
  moving.frames[1](0, 0) = 1;
  EXPECT_EQ(size_of(moving).moving, 1u);
  Case long_number = small;
  for (auto& frame : long_number.frames) frame(0, 0) = 0.1;
  EXPECT_LT(size_of(small), size_of(long_number));
  EXPECT_LT(size_of(long_number), size_of(moving));
  EXPECT_EQ(size_text(octahedron(), small),
            "8 triangles, 6 vertices, 1 step -> 4 triangles, 4 vertices, 1 step");
}

TEST(MeshSize, NumbersAreSimplerWhenTheyAreShorter) {
  EXPECT_EQ(number_cost(0), 0u);
  EXPECT_EQ(number_cost(-9), 9u);
  EXPECT_EQ(number_cost(10), 20u);
  EXPECT_EQ(number_cost(123), 30u);
  EXPECT_EQ(number_cost(0.5), 130u);
  EXPECT_LT(number_cost(0.25), number_cost(0.3125));
}

TEST(CaseEdits, ValidCasesOnly) {
  EXPECT_TRUE(is_valid(tetrahedron()));
  Case c = tetrahedron();
  c.triangles(0, 0) = 1;
  EXPECT_FALSE(is_valid(c));  // index twice
  c = tetrahedron();
  c.triangles(0, 0) = 4;
  EXPECT_FALSE(is_valid(c));  // out of range
  c = tetrahedron();
  c.triangles.row(1) = c.triangles.row(0).reverse();
  EXPECT_FALSE(is_valid(c));  // the same three vertices
  c = tetrahedron();
  c.frames[1](2, 2) = std::nan("");
  EXPECT_FALSE(is_valid(c));
  c = tetrahedron();
  c.frames.pop_back();
  EXPECT_TRUE(is_valid(c));  // a mesh at rest
  c.frames.clear();
  EXPECT_FALSE(is_valid(c));
  c = tetrahedron();
  c.view = corpus::CaseView{{{0, 0, 0}}, {}};
  EXPECT_FALSE(is_valid(c));  // one place for two frames
}

TEST(CaseEdits, MergingVerticesKeepsACycle) {
  const Case merged = merge_vertices(octahedron(), {0, 1, 2, 3, 4, 0});
  EXPECT_EQ(merged.triangles.rows(), 6);  // the two at the edge are gone
  EXPECT_EQ(merged.frames.front().rows(), 5);
  EXPECT_TRUE(is_closed(merged));
  // A chain of targets is followed to its end; opposite triangles cancel.
  const Case chain = merge_vertices(octahedron(), {4, 1, 2, 0, 4, 5});
  EXPECT_TRUE(is_closed(chain));
  EXPECT_TRUE(is_valid(chain));
  EXPECT_EQ(chain.triangles.rows(), 4);
}

TEST(CaseEdits, CutsAreClosedByFans) {
  const Case open = keep_triangles(octahedron(), {1, 1, 1, 1, 0, 0, 0, 0});
  EXPECT_EQ(open.frames.front().rows(), 5);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Case closed = close_loops(open, corner);
    EXPECT_TRUE(is_closed(closed));
    EXPECT_EQ(closed.triangles.rows(), 6);
    EXPECT_TRUE(is_valid(closed));
  }
}

TEST(CaseEdits, TheMiddleIsTheMeanOfAllPlaces) {
  Case c = tetrahedron();
  c.frames[1].col(2).array() += 1;
  const Case seen = seen_from_its_middle(c);
  EXPECT_EQ(seen.view->q0, std::vector<detector::Point>(2, {0.25, 0.25, 0.75}));
  EXPECT_TRUE(seen.view->q1.empty());
  EXPECT_TRUE(is_valid(seen));
}

TEST(CaseEdits, StepsKeepTheirFramesViewAndScript) {
  Case c = octahedron(4);
  c.view = corpus::CaseView{{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {}};
  const Case tail = with_steps(c, {{2, 3, true}});
  EXPECT_EQ(tail.frames.size(), 2u);
  EXPECT_TRUE(tail.script.empty());
  EXPECT_EQ(tail.view->q0, (std::vector<detector::Point>{{0, 0, 2}, {0, 0, 3}}));
  const Case apart = with_steps(c, {{0, 1, true}, {2, 3, false}});
  EXPECT_EQ(apart.frames.size(), 4u);
  EXPECT_EQ(apart.script, (std::vector<corpus::CaseStep>{{0, 1, true}, {2, 3, false}}));
}

TEST(CaseEdits, GhostsFollowTheMesh) {
  Case c = keep_triangles(octahedron(), {1, 1, 1, 1, 1, 1, 1, 0});
  const auto loops = oracle::boundary_loops(c.triangles);
  c.ghosts = corpus::CaseGhosts{{{{7, 7, 7}}, {{8, 8, 8}}}, oracle::ghost_triangles(loops, 6)};
  ASSERT_TRUE(oracle::closes(c.triangles, c.ghosts->triangles));
  const Case fewer = keep_triangles(c, {1, 1, 1, 1, 0, 0, 0});
  ASSERT_TRUE(fewer.ghosts);
  EXPECT_TRUE(is_valid(fewer));
  EXPECT_TRUE(oracle::closes(fewer.triangles, fewer.ghosts->triangles));
  EXPECT_EQ(fewer.ghosts->apexes[1], (std::vector<detector::Point>{{8, 8, 8}}));
  EXPECT_FALSE(close_loops(fewer, 0).ghosts);
}

TEST(SphereMeshes, AllOfThemAndAllAreCycles) {
  const std::size_t counts[] = {1, 10, 195, 5712};  // labelled triangulations of the sphere
  for (int n = 4; n <= 7; ++n) {
    const auto& all = sphere_meshes(n);
    EXPECT_EQ(all.size(), counts[n - 4]);
    EXPECT_EQ(std::set<SphereMesh>(all.begin(), all.end()).size(), all.size());
    for (const auto& mesh : all) {
      EXPECT_EQ(mesh.size(), static_cast<std::size_t>(2 * n - 4));
      const Case c = still_case(mesh, std::vector<detector::Point>(static_cast<std::size_t>(n)));
      if (!is_closed(c) || !is_valid(c)) FAIL() << n << " vertices";
    }
  }
}

}  // namespace
}  // namespace assay::properties
