// A relation goes on with what is left of the mesh, and becomes smaller itself.
#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes/passes.h"
#include "tests/properties/reducer/resting_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace toys;
using detector::CountedLevel, detector::CountedPairs, detector::TrianglePair;

// Two tetrahedra as bodies 0 and 1.
Case two_bodies() {
  Case c = still_case(
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 6, 5}, {4, 5, 7}, {5, 6, 7}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}});
  c.counted.emplace();
  c.counted->pairs.body = {0, 0, 0, 0, 1, 1, 1, 1};
  c.counted->pairs.apart = {{0, 1}, {1, 1}};
  return c;
}

TEST(RelationEdits, BodiesAndListsAreNumberedAnew) {
  Case c = two_bodies();
  auto& pairs = c.counted->pairs;
  pairs.triangle_pairs = {{0, 4}, {5, 6}, {4, 6}};
  pairs.rest_distance = 2;
  pairs.rest = corpus::points_of(c.frames[0]);
  const Case rest = keep_triangles(c, {0, 0, 0, 0, 0, 1, 1});
  ASSERT_TRUE(is_valid(rest));
  const auto& left = rest.counted->pairs;
  EXPECT_EQ(left.body, (std::vector<std::int32_t>{0, 0, 0, 0}));
  EXPECT_EQ(left.apart, (std::vector<std::array<std::int32_t, 2>>{{0, 0}}));
  EXPECT_EQ(left.triangle_pairs, (std::vector<TrianglePair>{{0, 1}}));
  ASSERT_EQ(left.rest.size(), 4u);
  EXPECT_EQ(left.rest[0], (detector::Point{5, 0, 0}));
}

TEST(RelationEdits, FeaturesThatAreGoneAreLeftOut) {
  Case c = octahedron();
  c.counted.emplace();
  auto& pairs = c.counted->pairs;
  pairs.level = CountedLevel::features;
  pairs.vertex_faces = {{5, 0}, {4, 7}, {0, 4}};
  pairs.edge_pairs = {{{0, 2}, {1, 3}}, {{4, 0}, {5, 1}}};
  ASSERT_TRUE(is_valid(c));
  // Vertex 0 becomes 2: triangles 0 and 4 go, 7 is then {2, 3, 5}.
  const Case merged = merge_vertices(c, {2, 1, 2, 3, 4, 5});
  ASSERT_TRUE(is_valid(merged));
  const auto& left = merged.counted->pairs;
  ASSERT_EQ(left.vertex_faces.size(), 1u);
  const auto [v, face] = left.vertex_faces[0];
  EXPECT_EQ(merged.frames[0].row(v), c.frames[0].row(4));
  EXPECT_EQ(merged.triangles.row(face).minCoeff(), 1);  // vertices 2, 3, 5 are now 1, 2, 4
  EXPECT_EQ(left.edge_pairs.size(), 1u) << "of 0-2 nothing is left";
}

TEST(RelationEdits, VerticesThatChangePlacesTakeTheirBodyAlong) {
  const Case c = two_bodies();
  detector::Triangles after(1, 3);
  after << 0, 1, 2;
  const auto carried = carried_over(c.counted->pairs, c.triangles, after,
                                    {{-1, -1, -1, -1, -1, 2, 0, 1}, {6, 7, 5}});
  EXPECT_EQ(carried.body, (std::vector<std::int32_t>{0, 0, 0}));
  EXPECT_EQ(carried.apart.size(), 1u);
}

TEST(RelationEdits, ACaseOfTwoBodiesInATriangleIsNotValid) {
  const Case joined = merge_vertices(two_bodies(), {0, 1, 2, 3, 4, 5, 2, 7});
  EXPECT_FALSE(is_valid(joined));
}

template <class Holds>
Case after_the_pass(const Case& c, Holds holds) {
  const ReduceLimits limits;
  const OnBetter nobody;
  const Judge judge = [holds](const Case& x) {
    return holds(x) ? std::optional(Finding{"planted", {0, 1}, 0}) : std::nullopt;
  };
  ReductionSearch search(c, judge, limits, nobody);
  EXPECT_TRUE(search.found());
  simplify_relation(search);
  return search.best();
}

TEST(RelationPass, WhatDoesNotMatterGoes) {
  Case c = two_bodies();
  auto& pairs = c.counted->pairs;
  pairs.triangle_pairs = {{0, 4}, {5, 6}, {4, 6}, {1, 2}};
  pairs.rings = 3;
  pairs.rest_distance = 2;
  pairs.rest = std::vector<detector::Point>(8, {0.1, 0.2, 0.3});
  const auto needs = [](const auto& condition) {
    return [condition](const Case& x) { return x.counted && condition(x.counted->pairs); };
  };
  EXPECT_FALSE(after_the_pass(c, [](const Case&) { return true; }).counted);
  const auto one_pair =
      after_the_pass(c, needs([](const CountedPairs& p) {
                       return std::count(p.triangle_pairs.begin(), p.triangle_pairs.end(),
                                         TrianglePair{5, 6}) == 1;
                     }));
  EXPECT_EQ(size_of(one_pair).relation, 1u);
  EXPECT_EQ(one_pair.counted->pairs.triangle_pairs, (std::vector<TrianglePair>{{5, 6}}));
  const auto rest = after_the_pass(
      c, needs([](const CountedPairs& p) { return p.rings >= 1 && p.rest_distance == 2; }));
  EXPECT_EQ(rest.counted->pairs.rings, 1);
  EXPECT_EQ(rest.counted->pairs.rest, corpus::points_of(c.frames[0])) << "simpler numbers";
}

}  // namespace
}  // namespace assay::properties
