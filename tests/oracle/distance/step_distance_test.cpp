#include "oracle/distance/step_distance.h"

#include "oracle/mesh/step.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::FeatureKind, detector::PairContact, detector::TimeEnclosure, detector::TrianglePair,
    test::positions, test::same, test::Step, test::triangles;

StepJudgement judge(const Step& step, const Separation& d, const DistanceOptions& options = {}) {
  return judge_distance({step.x_t0, step.x_t1}, step.f, d, options);
}
LeastDistance least(const Step& step, const DistanceOptions& options = {}) {
  return least_distance({step.x_t0, step.x_t1}, step.f, options);
}

DistanceOptions with_neighbours(int jobs = 1) {
  DistanceOptions options;
  options.jobs = jobs;
  options.neighbours = true;
  return options;
}

// A floor of two triangles, and a triangle that comes down on it, from 3 to 1.
Step falling_triangle() {
  return {positions({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {1, 2, 3}, {3, 2, 4}, {2, 1, 4}}),
          positions({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {1, 2, 1}, {3, 2, 2}, {2, 1, 2}}),
          triangles({{0, 1, 2}, {0, 2, 3}, {4, 5, 6}})};
}

TEST(StepDistance, FirstTimesOfPairs) {
  const StepJudgement judgement = judge(falling_triangle(), {2, 0});
  ASSERT_TRUE(judgement.complete);
  ASSERT_EQ(judgement.pairs.size(), 2u);
  EXPECT_EQ(judgement.first, (TimeEnclosure{0.5, 0.5}));
  // The vertex (1, 2) is above the second triangle.
  EXPECT_EQ(judgement.pairs[1].pair, (TrianglePair{1, 2}));
  EXPECT_EQ(judgement.pairs[1].time, (TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(judgement.pairs[1].feature.kind, FeatureKind::vertex_face);
  EXPECT_EQ(judgement.pairs[0].pair, (TrianglePair{0, 2}));
  EXPECT_GT(judgement.pairs[0].time.lo, 0.5);
  EXPECT_TRUE(judge(falling_triangle(), {0.5, 0.25}).pairs.empty());
  EXPECT_EQ(judge(falling_triangle(), {3, 0}).first, (TimeEnclosure{0, 0}));
}

TEST(StepDistance, LeastOfAStep) {
  const LeastDistance found = least(falling_triangle());
  ASSERT_TRUE(found.complete);
  EXPECT_EQ(found.distance, 1);
  ASSERT_TRUE(found.where);
  EXPECT_EQ(found.where->pair, (TrianglePair{1, 2}));
  EXPECT_EQ(found.where->time, (TimeEnclosure{1, 1}));
  EXPECT_EQ(found.where->feature.vertices, (std::array<std::int32_t, 5>{4, 0, 2, 3, -1}));
  // Neighbours are as near as what they do not share, here the far corners of the floor, which are
  // farther away.
  EXPECT_EQ(least(falling_triangle(), with_neighbours()).distance, 1);
}

TEST(StepDistance, NoPairIsAtNoDistance) {
  const auto x = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  const LeastDistance found = least({x, x, triangles({{0, 1, 2}})}, with_neighbours());
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(found.where);
  const Step floor = {x, x, triangles({{0, 1, 2}, {2, 1, 3}})};
  EXPECT_EQ(least(floor).distance, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(judge(floor, {100, 0}).pairs.empty());
  // Each corner that they do not share is 1/sqrt 2 from the shared edge, which the other one holds.
  EXPECT_EQ(least(floor, with_neighbours()).distance, std::sqrt(0.5));
}

// Two large triangles pierce each other far from all corners and edges of the other.
Step pierced_at_rest() {
  const auto x =
      positions({{-50, -50, 0}, {50, -50, 0}, {0, 80, 0}, {-9, 0, -40}, {9, 0, -40}, {0, 0, 40}});
  return {x, x, triangles({{0, 1, 2}, {3, 4, 5}})};
}

TEST(StepDistance, PiercedAtTheStart) {
  const StepJudgement judgement = judge(pierced_at_rest(), {0.5, 0.5});
  ASSERT_EQ(judgement.pairs.size(), 1u);
  EXPECT_EQ(judgement.first, (TimeEnclosure{0, 0}));
  EXPECT_EQ(judgement.pairs[0].feature.kind, FeatureKind::piercing);
  const LeastDistance found = least(pierced_at_rest());
  EXPECT_EQ(found.distance, 0);
  EXPECT_EQ(found.where->feature.kind, FeatureKind::piercing);
}

// They share a vertex, and the edge opposite of it pierces.
TEST(StepDistance, PiercedByANeighbour) {
  const auto x = positions({{0, 0, 0}, {100, -60, 0}, {100, 60, 0}, {60, 0, -50}, {60, 0, 50}});
  const Step step = {x, x, triangles({{0, 1, 2}, {0, 3, 4}})};
  EXPECT_TRUE(judge(step, {1, 0}).pairs.empty());
  const StepJudgement judgement = judge(step, {1, 0}, with_neighbours());
  ASSERT_EQ(judgement.pairs.size(), 1u);
  EXPECT_EQ(judgement.pairs[0].feature.kind, FeatureKind::piercing);
  EXPECT_EQ(least(step, with_neighbours()).distance, 0);
  EXPECT_EQ(least(step).distance, std::numeric_limits<double>::infinity());
}

TEST(StepDistance, PairsThatAreAskedFor) {
  DistanceOptions options;
  options.also_asked = [](std::int32_t a, std::int32_t b) {
    EXPECT_LT(a, b);
    return a != 1;
  };
  const StepJudgement judgement = judge(falling_triangle(), {2, 0}, options);
  ASSERT_EQ(judgement.pairs.size(), 1u);
  EXPECT_EQ(judgement.pairs[0].pair, (TrianglePair{0, 2}));
  EXPECT_GT(least(falling_triangle(), options).distance, 1);
}

TEST(StepDistance, OffsetsOfBodies) {
  DistanceOptions options;
  options.offsets = {1.5, 1.5, 1.5, 1.5, 0.5, 0.5, 0.5};
  EXPECT_EQ(judge(falling_triangle(), {}, options).first, (TimeEnclosure{0.5, 0.5}));
  EXPECT_TRUE(
      same(judge(falling_triangle(), {}, options).pairs, judge(falling_triangle(), {2, 0}).pairs));
  std::fill(options.offsets.begin(), options.offsets.end(), 0.25);
  EXPECT_TRUE(judge(falling_triangle(), {}, options).pairs.empty());
}

TEST(StepDistance, Stops) {
  DistanceOptions options = with_neighbours();
  options.stop = [] { return true; };
  EXPECT_FALSE(judge(falling_triangle(), {2, 0}, options).complete);
  EXPECT_FALSE(least(falling_triangle(), options).complete);
}

// Some triangles over few vertices, so that they share many; coordinates as of the kind.
Step random_step(test::Random& random, test::Coordinates kind, int vertices, int count) {
  Step step;
  place_randomly(random, kind, vertices, step.x_t0, step.x_t1);
  step.f = random_triangles(random, vertices, count);
  return step;
}

TEST(StepDistance, WithinZeroAreTheContacts) {
  test::Random random(165);
  int contacts = 0;
  for (int kind = 0; kind < test::coordinate_kinds; ++kind) {
    for (int i = 0; i < 8; ++i) {
      const Step step = random_step(random, static_cast<test::Coordinates>(kind), 9, 8);
      const StepJudgement expected = judge_step({step.x_t0, step.x_t1}, step.f, {});
      const StepJudgement found = judge(step, {0, 0}, with_neighbours());
      ASSERT_TRUE(same(found.pairs, expected.pairs)) << kind << " " << i;
      EXPECT_EQ(found.first, expected.first);
      contacts += static_cast<int>(expected.pairs.size());
    }
  }
  for (const Step& step : {test::turning_tetrahedron(), test::collapsing_octahedron(),
                           test::intersecting_octahedron(), test::seven_vertices_about_a_line()}) {
    EXPECT_TRUE(same(judge(step, {0, 0}, with_neighbours()).pairs,
                     judge_step({step.x_t0, step.x_t1}, step.f, {}).pairs));
  }
  EXPECT_GT(contacts, 100);
}

TEST(StepDistance, LeastAgreesWithFirstTimes) {
  test::Random random(166);
  int above = 0;
  for (int i = 0; i < 60; ++i) {
    Step step = random_step(
        random, i % 2 == 0 ? test::Coordinates::generic : test::Coordinates::tiny_grid, 12, 4);
    step.x_t1 = 0.75 * step.x_t0 + 0.25 * step.x_t1;
    const LeastDistance found = least(step);
    if (!found.where) continue;
    const StepJudgement there = judge(step, {found.distance, 0});
    ASSERT_FALSE(there.pairs.empty());
    EXPECT_TRUE(same({there.pairs.front()}, {*found.where}));
    if (found.distance == 0) continue;
    ++above;
    EXPECT_TRUE(judge(step, {std::nextafter(found.distance, 0), 0}).pairs.empty());
  }
  EXPECT_GT(above, 2);
}

TEST(StepDistance, SameBytesForAnyNumberOfThreads) {
  test::Random random(167);
  const Step step = random_step(random, test::Coordinates::generic, 60, 40);
  const StepJudgement one = judge(step, {0.125, 0}, with_neighbours(1));
  const StepJudgement three = judge(step, {0.125, 0}, with_neighbours(3));
  EXPECT_TRUE(same(one.pairs, three.pairs));
  EXPECT_EQ(one.rungs, three.rungs);
  EXPECT_EQ(one.feature_candidates, three.feature_candidates);
  EXPECT_EQ(one.first, three.first);
}

}  // namespace
}  // namespace assay::oracle
