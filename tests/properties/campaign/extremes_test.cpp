// How far a case goes, told of cases that are known by heart.
#include "properties/campaign/trials/case_tally.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A fan of five triangles about vertex 0, and a triangle by itself, in so many frames.
corpus::Case fan_and_triangle(int frames) {
  corpus::Case c;
  c.triangles = tests::triangles_of("0 1 2, 0 2 3, 0 3 4, 0 4 5, 0 5 6, 7 8 9");
  for (int f = 0; f < frames; ++f)
    c.frames.emplace_back(detector::Positions::Constant(10, 3, f));  // each at another place
  return c;
}

TEST(Extremes, OfTheMesh) {
  const auto most = extremes_of(fan_and_triangle(2), {});
  EXPECT_EQ(most, (Extremes{1, 5, 0, 2, 0, 6}));
  // Components go by vertices, so the one by itself is joined at a corner.
  auto joined = fan_and_triangle(2);
  joined.triangles(5, 0) = 0;
  EXPECT_EQ(extremes_of(joined, {}), (Extremes{1, 6, 0, 1, 0, 6}));
}

TEST(Extremes, BodiesAreThoseOfARelation) {
  auto c = fan_and_triangle(2);
  c.counted.emplace().pairs.rings = 2;
  EXPECT_EQ(extremes_of(c, {}).bodies, 0u);
  c.counted->pairs.body = {0, 0, 0, 0, 0, 0, 0, 2, 2, 2};
  EXPECT_EQ(extremes_of(c, {}).bodies, 3u);
}

TEST(Extremes, StepsGoOnFromCommittedOnesAlone) {
  auto c = fan_and_triangle(6);
  EXPECT_EQ(extremes_of(c, {}).steps_in_a_row, 5u);
  EXPECT_EQ(new_starts(c), std::vector<std::size_t>{0});
  const auto told = [&](std::vector<corpus::CaseStep> script) {
    c.script = std::move(script);
    return new_starts(c);
  };
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(told({{0, 1}, {1, 2}, {3, 4}, {4, 5}, {5, 0}}), (Places{0, 2}));
  EXPECT_EQ(extremes_of(c, {}).steps_in_a_row, 3u);
  // What is evaluated and not committed goes on, and is gone on from by nobody.
  EXPECT_EQ(told({{0, 1}, {1, 2, false}, {1, 3}, {2, 3}}), (Places{0, 3}));
  EXPECT_EQ(extremes_of(c, {}).steps_in_a_row, 3u);
  EXPECT_EQ(told({{0, 1, false}, {1, 2}, {2, 3}}), (Places{0, 1}));
  EXPECT_EQ(extremes_of(c, {}).steps_in_a_row, 2u);
}

TEST(Extremes, PairsAreThoseOfTheFullestStep) {
  std::vector<oracle::StepJudgement> truth(3);
  truth[0].pairs.resize(2);
  truth[1].pairs.resize(7);
  EXPECT_EQ(extremes_of(fan_and_triangle(4), truth).pairs, 7u);
}

TEST(Extremes, OfManyTheLargerOfEachStays) {
  Extremes most{1, 20, 3, 40, 5, 60};
  most.include({10, 2, 30, 4, 50, 6});
  EXPECT_EQ(most, (Extremes{10, 20, 30, 40, 50, 60}));
}

}  // namespace
}  // namespace assay::properties
