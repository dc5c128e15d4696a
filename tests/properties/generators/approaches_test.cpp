// Each drawn approach is at the distance that it was made for, by the oracle.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

#include "detector/mesh/mesh_checks.h"
#include "oracle/distance/step_distance.h"
#include "properties/generators/added_bodies.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/plugin/query_case.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

corpus::Case two_triangles(const Approach& approach) {
  corpus::Case c;
  c.id = "approach";
  c.triangles.resize(2, 3);
  c.triangles << 0, 1, 2, 3, 4, 5;
  c.frames.assign(2, detector::Positions(6, 3));
  for (int i = 0; i < 6; ++i) {
    const auto& point = i < 3 ? approach.a[static_cast<std::size_t>(i)]
                              : approach.b[static_cast<std::size_t>(i - 3)];
    c.frames[0].row(i) << point.t0[0], point.t0[1], point.t0[2];
    c.frames[1].row(i) << point.t1[0], point.t1[1], point.t1[2];
  }
  return c;
}

// How the least distance of an approach compares with d.
std::string place_of(double least, double d) {
  if (least == d) return "at d";
  if (least == std::nextafter(d, 0.0)) return "the double before d";
  if (least == std::nextafter(d, std::numeric_limits<double>::infinity()))
    return "the double after d";
  return least == d / 2 ? "half of d" : least == d - d * 0x1p-20 ? "just inside" : "elsewhere";
}

TEST(Approaches, AreAtTheDistanceThatTheyAreMadeFor) {
  for (const double d : {0.01, 1.0, 3e-7, 12345.678, 0x1p-890, 0x1p890}) {
    std::map<std::string, int> places;
    std::map<bool, int> near, near_at_start;
    for (std::uint64_t i = 0; i < 400; ++i) {
      Random random(7, i);
      const auto c = two_triangles(draw_approach(random, d));
      const auto least = oracle::least_distance({c.frames[0], c.frames[1]}, c.triangles).distance;
      ++places[place_of(least, d)];
      const Contract within = {.adjacency = Adjacency::no_shared_vertex, .separation = d};
      const auto truth = truth_of(c, judge_case(c, within).front(), within);
      ASSERT_EQ(truth.first.has_value(), least <= d) << i;
      ++near[truth.first.has_value()];
      ++near_at_start[truth.starts_near];
    }
    EXPECT_EQ(places.count("elsewhere"), 0u) << d;
    EXPECT_EQ(places.size(), 5u) << d;
    for (const bool is : {false, true}) {
      EXPECT_GT(near[is], 60) << d;
      EXPECT_GT(near_at_start[is], 5) << d;
    }
  }
}

TEST(Approaches, AreAddedToAMeshOrTakeTheirPlaceAsAQuery) {
  Random random(3, 1);
  const auto mesh = make_case(families().front(), "tiny:1:closed-generic:4").c;
  const auto with = with_approach(mesh, 0.5, random);
  EXPECT_EQ(with.triangles.rows(), mesh.triangles.rows() + 2);
  EXPECT_EQ(with.frames.size(), mesh.frames.size());
  EXPECT_EQ(with.frames.front().rows(), mesh.frames.front().rows() + 6);
  EXPECT_FALSE(with.view || with.ghosts || with.expected.answer);
  // The case's relation speaks of the new vertices too, and lets the two triangles meet.
  for (int i = 0; i < 40; ++i) {
    auto related = make_case(counted_families().front(), fmt::format("tiny:1:counted:{}", i)).c;
    ASSERT_TRUE(related.counted);
    const auto met = with_approach(related, 0.5, random);
    const auto vertices = met.frames.front().rows();
    EXPECT_FALSE(detector::check_counted_pairs(met.counted->pairs, met.triangles, vertices)) << i;
    EXPECT_TRUE(met.counted->steps.empty());
  }
  const auto query = case_of_query({{}, 2}, "query");
  const auto aimed = query_of(with_approach(query, 0.5, random));
  ASSERT_TRUE(aimed);
  EXPECT_EQ(aimed->first_group, 2);
}

}  // namespace
}  // namespace assay::properties
