// The facts of queries whose answers are plain to see.
#include "properties/vectors/query_facts.h"

#include <gtest/gtest.h>

#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::FourPoints;
using detector::Point;
using enum VectorFlag;

// A vertex that moves from `from` to `to`, and a face at rest in the plane z = 0.
FourPoints vertex_on_face(const Point& from, const Point& to) {
  FourPoints query;
  query.points = {
      {{from, to}, {{-1, -1, 0}, {-1, -1, 0}}, {{3, -1, 0}, {3, -1, 0}}, {{-1, 3, 0}, {-1, 3, 0}}}};
  return query;
}

std::set<VectorFlag> flags(const FourPoints& query) {
  return flags_of(query, contact_facts(query), 0, VectorPrecision::float64);
}

TEST(ContactFacts, WhatPassesIsACollision) {
  const auto facts = contact_facts(vertex_on_face({0, 0, 1}, {0, 0, -1}));
  EXPECT_EQ(facts.result, VectorResult::collision);
  EXPECT_EQ(facts.first, (detector::TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(facts.polynomial, (std::vector<std::string>{"-1", "2"}));
}

TEST(ContactFacts, WhatOnlyComesToThePlaneIsAcceptable) {
  const auto at_end = vertex_on_face({0, 0, 1}, {0, 0, 0});
  EXPECT_EQ(contact_facts(at_end).result, VectorResult::acceptable);
  EXPECT_TRUE(flags(at_end).contains(VectorFlag::at_end));
  const auto slides = vertex_on_face({-4, 0, 0}, {4, 0, 0});
  EXPECT_EQ(contact_facts(slides).result, VectorResult::acceptable);
  EXPECT_TRUE(flags(slides).contains(coplanar_throughout));
  EXPECT_EQ(contact_facts(slides).first, (detector::TimeEnclosure{0.375, 0.375}));
}

TEST(ContactFacts, APassageThroughTheEndOfAFeatureIsACollision) {
  const auto through_edge = vertex_on_face({1, 1, 1}, {1, 1, -1});
  EXPECT_EQ(contact_facts(through_edge).result, VectorResult::collision);
  EXPECT_TRUE(flags(through_edge).contains(touch_at_end));
  EXPECT_FALSE(flags(vertex_on_face({0, 0, 1}, {0, 0, -1})).contains(touch_at_end));
}

TEST(ContactFacts, BesideTheFaceIsFree) {
  const auto facts = contact_facts(vertex_on_face({4, 4, 1}, {4, 4, -1}));
  EXPECT_EQ(facts, VectorFacts());
}

// The vertex moves at height 1 over a face whose far corner sinks: over the face its height is
// 1 - t (4 - 4t), the square of 2t - 1.
TEST(ContactFacts, ADoubleRootIsATouch) {
  FourPoints query;
  query.points = {{{{0, -4, 1}, {0, 4, 1}},
                   {{-4, -4, 0}, {-4, -4, 0}},
                   {{4, -4, 0}, {4, -4, 0}},
                   {{0, 4, 4}, {0, 4, 0}}}};
  const auto facts = contact_facts(query);
  EXPECT_EQ(facts.first, (detector::TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(facts.result, VectorResult::acceptable);
  EXPECT_TRUE(flags(query).contains(double_root));
  query.points[0].t0[2] = query.points[0].t1[2] = 0.75;
  EXPECT_EQ(contact_facts(query).result, VectorResult::collision);
  EXPECT_FALSE(flags(query).contains(double_root));
}

TEST(DistanceFacts, TheDistanceItselfIsAcceptable) {
  const auto query = vertex_on_face({0, 0, 3}, {0, 0, 2});
  EXPECT_EQ(distance_facts(query, 2).result, VectorResult::acceptable);
  EXPECT_EQ(distance_facts(query, 2).first, (detector::TimeEnclosure{1, 1}));
  EXPECT_EQ(distance_facts(query, 1.5).result, VectorResult::free);
  const auto near = distance_facts(query, 2.5);
  EXPECT_EQ(near.result, VectorResult::collision);
  EXPECT_EQ(near.first, (detector::TimeEnclosure{0.5, 0.5}));
  EXPECT_EQ(near.least_distance, 2.0);
  EXPECT_EQ(near.polynomial.size(), 3u);
}

TEST(NumberFlags, GoByTheCoordinates) {
  const auto of = [](const FourPoints& query, VectorPrecision precision) {
    return number_flags_of(query.points, precision);
  };
  using enum VectorPrecision;
  auto query = vertex_on_face({0, 0, 1}, {0, 0, -1});
  EXPECT_TRUE(of(query, float64).empty());
  query.points[0].t0[0] = 0x1p-1070;
  EXPECT_EQ(of(query, float64), (std::set{denormal, mixed_scales}));
  query.points[0].t0[0] = 0x1p-130;
  EXPECT_EQ(of(query, float64), (std::set{mixed_scales}));
  EXPECT_EQ(of(query, float32), (std::set{denormal, mixed_scales}));
  query = vertex_on_face({0, 0, 1}, {0, 0, -5000});
  EXPECT_EQ(of(query, float64), (std::set{huge_step}));
  query = vertex_on_face({0, 0, 1}, {0, 0, 1});
  EXPECT_EQ(of(query, float64), (std::set{at_rest}));
  for (auto& p : query.points) p.t0[2] = p.t1[2] = p.t0[2] + 0x1p30;
  EXPECT_EQ(of(query, float64), (std::set{at_rest, far_from_origin}));
}

}  // namespace
}  // namespace assay::properties
