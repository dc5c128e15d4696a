// Each pass of the reducer by itself, with judges that prescribe what must stay in the case. Also
// sizes, edits and sphere meshes.
#include <Eigen/Geometry>

#include "corpus/cases/case_file.h"
#include "corpus/scenes/shapes.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/reducer.h"
#include "properties/reducer/search.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// Small cases in which nothing moves.

Case still_case(const detector::Triangles& triangles, const detector::Positions& positions,
                std::size_t frames = 2) {
  Case c;
  c.triangles = triangles;
  c.frames.assign(frames, positions);
  return c;
}
Case still_case(const std::string& triangles, const std::string& positions) {
  return still_case(tests::triangles_of(triangles), tests::positions_of(positions));
}

Case octahedron(std::size_t frames = 2) {
  return still_case(tests::octahedron(),
                    tests::positions_of("2 0 0, -2 0 0, 0 2 0, 0 -2 0, 0 0 2, 0 0 -2"), frames);
}

const char* const corners_of_a_tetrahedron = "0 0 0, 1 0 0, 0 1 0, 0 0 1";
Case tetrahedron() { return still_case("0 2 1, 0 1 3, 1 2 3, 2 0 3", corners_of_a_tetrahedron); }

bool is_closed(const Case& c) { return oracle::unmatched_edges(c.triangles).empty(); }

// Both meshes, the second moved along x by 10 and named behind the first.
Case together(const Case& a, const Case& b) {
  Case c = a;
  const auto n = a.frames.front().rows();
  c.triangles.conservativeResize(a.triangles.rows() + b.triangles.rows(), Eigen::NoChange);
  c.triangles.bottomRows(b.triangles.rows()) = b.triangles.array() + static_cast<std::int32_t>(n);
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    c.frames[f].conservativeResize(n + b.frames[f].rows(), Eigen::NoChange);
    c.frames[f].bottomRows(b.frames[f].rows()) = b.frames[f];
    c.frames[f].bottomRows(b.frames[f].rows()).col(0).array() += 10;
  }
  return c;
}

template <class Holds>
Judge fails_when(Holds holds) {
  return [holds](const Case& c) {
    return holds(c) ? std::optional(Finding{"planted", {0, 1}, 0}) : std::nullopt;
  };
}

// What one pass makes of a case.
Case after(void (*pass)(ReductionSearch&), const Case& c, const Judge& judge) {
  const ReduceLimits limits;
  const OnBetter nobody;
  ReductionSearch search(c, judge, limits, nobody);
  EXPECT_TRUE(search.has_finding());
  pass(search);
  EXPECT_TRUE(is_valid(search.best()));
  return search.best();
}

TEST(StepPasses, OnlyTheStepsThatMatterStay) {
  Case c = octahedron(7);
  for (std::size_t f = 0; f < 7; ++f) c.frames[f](0, 0) = static_cast<double>(f);
  const auto steps = [](const Case& x) {
    std::set<std::pair<double, double>> found;
    for (const auto& s : corpus::steps_of(x))
      found.emplace(start_of(x, s)(0, 0), end_of(x, s)(0, 0));
    return found;
  };
  const auto dropped = after(drop_steps, c, fails_when([&](const Case& x) {
                               return steps(x).contains({1, 2}) && steps(x).contains({4, 5});
                             }));
  EXPECT_EQ(steps(dropped), (std::set<std::pair<double, double>>{{1, 2}, {4, 5}}));
  const auto merged = after(merge_steps, c, fails_when([&](const Case& x) {
                              return x.frames.front()(0, 0) == 0 && x.frames.back()(0, 0) == 6;
                            }));
  EXPECT_EQ(merged.frames.size(), 2u);
  const auto truncated = after(drop_later_steps, c, fails_when([](const Case&) { return true; }));
  EXPECT_EQ(truncated.frames.size(), 2u);
}

TEST(FacePasses, ComponentsAndFacesThatDoNotMatterGo) {
  Case many = tetrahedron();
  for (int i = 0; i < 4; ++i) many = together(many, tetrahedron());
  const auto one = after(drop_components, many, fails_when([](const Case& c) {
                           return c.frames.front().col(0).maxCoeff() == 11 && is_closed(c);
                         }));
  EXPECT_EQ(one.triangles.rows(), 4);

  const auto two = after(drop_faces, octahedron(), fails_when([](const Case& c) {
                           const auto& x = c.frames.front().col(2);
                           return x.maxCoeff() == 2 && x.minCoeff() == -2;
                         }));
  EXPECT_EQ(two.triangles.rows(), 2);

  const auto near = after(keep_rings, octahedron(), fails_when([](const Case&) { return true; }));
  EXPECT_EQ(near.triangles.rows(), 2);  // the reported pair
}

TEST(ClosedPasses, EachMakesAClosedMeshSmallerAndKeepsItClosed) {
  const Judge closed = fails_when(is_closed);
  const auto sphere = corpus::sphere_shape(80);
  const Case large = still_case(sphere.triangles, sphere.positions);
  ASSERT_TRUE(is_closed(large));
  for (const auto pass :
       {cone_outside, cut_and_close, merge_balls, collapse_to_parents, collapse_edges,
        remove_and_close, try_spheres_of_pair, try_small_spheres}) {
    const Case smaller = after(pass, large, closed);
    EXPECT_LT(smaller.triangles.rows(), 80);
    EXPECT_TRUE(is_closed(smaller));
  }
  EXPECT_EQ(after(collapse_edges, large, closed).triangles.rows(), 4);
  EXPECT_EQ(after(try_small_spheres, large, closed).triangles.rows(), 4);
  EXPECT_LT(after(merge_twice, octahedron(), closed).triangles.rows(), 8);
}

TEST(MotionPasses, VerticesComeToRest) {
  Case c = octahedron(3);
  for (std::size_t f = 1; f < 3; ++f) c.frames[f].array() += static_cast<double>(f);
  const auto still = after(freeze_vertices, c, fails_when([](const Case& x) {
                             // The third vertex must move in the second step.
                             return x.frames[1].row(2) != x.frames[2].row(2);
                           }));
  EXPECT_EQ(size_of(still).moving, 1u);
}

TEST(ViewPasses, AFixedPointAtTheOrigin) {
  Case c = octahedron();
  c.view = corpus::CaseView{{{1, 2, 3}, {3, 2, 1}}, {{4, 5, 6}, {6, 5, 4}}};
  const auto simple =
      after(simplify_view, c, fails_when([](const Case& x) { return x.view.has_value(); }));
  EXPECT_EQ(simple.view->q0, std::vector<detector::Point>(2, {0, 0, 0}));
  EXPECT_TRUE(simple.view->q1.empty());
  EXPECT_FALSE(after(drop_view, c, fails_when([](const Case&) { return true; })).view);
}

TEST(NumberPasses, CoordinatesBecomeSmallIntegers) {
  Case c = tetrahedron();
  for (auto& frame : c.frames) {
    frame.array() *= 0.123456;
    frame.array() += 77.7;
  }
  // A volume stays, whatever its size.
  const Judge solid = fails_when([](const Case& x) {
    const auto& p = x.frames[0];
    const Eigen::Vector3d a = p.row(1) - p.row(0), b = p.row(2) - p.row(0), d = p.row(3) - p.row(0);
    return std::abs(a.dot(b.cross(d))) > 1e-9;
  });
  const auto total = [](const Case& x) { return size_of(x).numbers; };
  for (const auto pass : {translate, round_all, round_vertices})
    EXPECT_LT(total(after(pass, c, solid)), total(c));
  Case integers = c;
  for (auto& frame : integers.frames) frame = (frame.array() * 10).round().matrix();
  ASSERT_TRUE(solid(integers));
  const auto simple = after(simplify_numbers, integers, solid);
  EXPECT_LE(total(simple), 2 * 12u);
  EXPECT_LT(total(after(simplify_together, integers, solid)), total(integers));
}

TEST(NumberPasses, SimplerValuesCostLessAndComeInOrder) {
  for (const double value : {0.7, -123.456, 1e300, -5e-324, 42.0, -7.0, 1.0}) {
    std::uint64_t last = 0;
    for (const double simpler : simpler_values(value)) {
      EXPECT_LT(number_cost(simpler), number_cost(value));
      EXPECT_GE(number_cost(simpler), last);
      last = number_cost(simpler);
    }
  }
  EXPECT_TRUE(simpler_values(0).empty());
  EXPECT_EQ(rounded_to_digits(-123.456, 2), -120);
}

TEST(OrderPass, NumberedByUseWithTheLowestCornerFirst) {
  const Case c = still_case("3 1 2, 0 3 2, 1 3 0, 2 1 0", corners_of_a_tetrahedron);
  const auto ordered = after(canonical_order, c, fails_when(is_closed));
  EXPECT_EQ(ordered.triangles, (detector::Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
  EXPECT_EQ(size_of(ordered), size_of(c));
  EXPECT_EQ(ordered.frames[0].row(0), c.frames[0].row(3));
}

TEST(Escape, LeavesALocalMinimum) {
  // Fails with an octahedron, and with a tetrahedron whose first vertex is somewhere else: no
  // single merge leads there.
  const Judge judge = fails_when([](const Case& c) {
    return is_closed(c) && (c.triangles.rows() == 8 || c.frames[0].row(0).sum() == 5);
  });
  const Case stuck = octahedron();
  EXPECT_EQ(after(collapse_edges, stuck, judge).triangles.rows(), 8);
  EXPECT_LT(after(escape, stuck, judge).triangles.rows(), 8);
}

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
  // Numbers are simpler when they are shorter.
  const std::pair<double, std::uint64_t> costs[] = {
      {0, 0}, {-9, 9}, {10, 20}, {123, 30}, {0.5, 130}};
  for (const auto& [number, cost] : costs) EXPECT_EQ(number_cost(number), cost) << number;
  EXPECT_LT(number_cost(0.25), number_cost(0.3125));
}

TEST(CaseEdits, ValidCasesOnly) {
  const std::pair<std::function<void(Case&)>, bool> changes[] = {
      {[](Case&) {}, true},
      {[](Case& c) { c.triangles(0, 0) = 1; }, false},  // index twice
      {[](Case& c) { c.triangles(0, 0) = 4; }, false},  // out of range
      // The same three vertices.
      {[](Case& c) { c.triangles.row(1) = c.triangles.row(0).reverse(); }, false},
      {[](Case& c) { c.frames[1](2, 2) = std::nan(""); }, false},
      {[](Case& c) { c.frames.pop_back(); }, true},  // a mesh at rest
      {[](Case& c) { c.frames.clear(); }, false},
      // One place for two frames.
      {[](Case& c) {
         c.view = corpus::CaseView{{{0, 0, 0}}, {}};
       },
       false}};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Case c = tetrahedron();
    changes[i].first(c);
    EXPECT_EQ(is_valid(c), changes[i].second) << i;
  }
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
      const Case c = still_case(tests::triangles(mesh), detector::Positions::Zero(n, 3));
      if (!is_closed(c) || !is_valid(c)) FAIL() << n << " vertices";
    }
  }
}

// A relation goes on with what is left of the mesh, and becomes smaller itself.

using detector::CountedLevel, detector::CountedPairs, detector::TrianglePair;

// Two tetrahedra as bodies 0 and 1.
Case two_bodies() {
  Case c = still_case("0 2 1, 0 1 3, 1 2 3, 2 0 3, 4 6 5, 4 5 7, 5 6 7",
                      "0 0 0, 1 0 0, 0 1 0, 0 0 1, 5 0 0, 6 0 0, 5 1 0, 5 0 1");
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
  EXPECT_FALSE(is_valid(merge_vertices(two_bodies(), {0, 1, 2, 3, 4, 5, 2, 7})))
      << "in one triangle";
}

TEST(RelationPass, WhatDoesNotMatterGoes) {
  Case c = two_bodies();
  auto& pairs = c.counted->pairs;
  pairs.triangle_pairs = {{0, 4}, {5, 6}, {4, 6}, {1, 2}};
  pairs.rings = 3;
  pairs.rest_distance = 2;
  pairs.rest = std::vector<detector::Point>(8, {0.1, 0.2, 0.3});
  const auto after_the_pass = [&](const std::function<bool(const CountedPairs&)>& needs) {
    return after(simplify_relation, c,
                 fails_when([=](const Case& x) { return x.counted && needs(x.counted->pairs); }));
  };
  EXPECT_FALSE(after(simplify_relation, c, fails_when([](const Case&) { return true; })).counted);
  const auto one_pair = after_the_pass([](const CountedPairs& p) {
    const auto& list = p.triangle_pairs;
    return std::count(list.begin(), list.end(), TrianglePair{5, 6}) == 1;
  });
  EXPECT_EQ(size_of(one_pair).relation, 1u);
  EXPECT_EQ(one_pair.counted->pairs.triangle_pairs, (std::vector<TrianglePair>{{5, 6}}));
  const auto rest =
      after_the_pass([](const CountedPairs& p) { return p.rings >= 1 && p.rest_distance == 2; });
  EXPECT_EQ(rest.counted->pairs.rings, 1);
  EXPECT_EQ(rest.counted->pairs.rest, corpus::points_of(c.frames[0])) << "simpler numbers";
}

}  // namespace
}  // namespace assay::properties
