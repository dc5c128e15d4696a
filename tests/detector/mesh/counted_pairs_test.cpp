// Relations between pairs: which ones are refused, and what a detector makes of a valid one when it
// is created.
#include "detector/mesh/counted_pairs.h"

#include "detector/detector.h"
#include "detector/mesh/mesh_checks.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

// Two triangles that share an edge, and one apart from them.
const Triangles triangles = (Triangles(3, 3) << 0, 1, 2, 1, 0, 3, 4, 5, 6).finished();
constexpr Eigen::Index vertices = 7;

Positions places() {
  Positions x(vertices, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 2, 1, 0, 2, 0, 1, 2;
  return x;
}

std::optional<InputError> error_of(const CountedPairs& counted) {
  const auto problem = check_counted_pairs(counted, triangles, vertices);
  const auto result = Detector::create(triangles, places(), {.counted = &counted});
  EXPECT_EQ(result.has_value(), !problem);
  if (!problem) return std::nullopt;
  EXPECT_EQ(result.error().error, problem->error);
  EXPECT_EQ(result.error().message, problem->message);
  EXPECT_FALSE(problem->message.empty());
  return problem->error;
}

template <class Change>
std::optional<InputError> error_with(const Change& change,
                                     CountedLevel level = CountedLevel::triangles) {
  CountedPairs counted;
  counted.level = level;
  change(counted);
  return error_of(counted);
}

TEST(CountedPairs, EveryKindMayBeGiven) {
  EXPECT_TRUE(CountedPairs{}.count_all());
  EXPECT_FALSE(error_of({}));
  CountedPairs counted;
  counted.body = {0, 0, 0, 0, 1, 1, 1};
  counted.apart = {{1, 0}, {0, 0}};
  counted.rings = std::numeric_limits<std::int32_t>::max();
  counted.rest_distance = 1e-300;
  counted.rest.assign(vertices, {0, 0, 0});
  counted.triangle_pairs = {{2, 0}};
  EXPECT_FALSE(counted.count_all());
  EXPECT_FALSE(error_of(counted));
  EXPECT_FALSE(error_with(
      [](auto& c) {
        c.vertex_faces = {{4, 0}}, c.edge_pairs = {{{1, 0}, {4, 6}}};
      },
      CountedLevel::features));
}

TEST(CountedPairs, WhatCannotBeSoIsRefusedByName) {
  using enum InputError;
  EXPECT_EQ(error_with([](auto& c) { c.body = {0, 0, 0}; }), wrong_frame_size);
  EXPECT_EQ(error_with([](auto& c) { c.body = {0, 0, 0, 0, 1, 1, -1}; }), index_out_of_range);
  EXPECT_EQ(error_with([](auto& c) { c.body = {0, 0, 0, 1, 2, 2, 2}; }), triangle_of_two_bodies);
  EXPECT_EQ(error_with([](auto& c) { c.apart = {{0, 1}}; }), index_out_of_range);
  EXPECT_EQ(error_with([](auto& c) { c.rings = -1; }), wrong_relation);
  for (const double distance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(error_with([&](auto& c) { c.rest_distance = distance; }), wrong_relation) << distance;
  CountedPairs counted;
  counted.rest_distance = 1;
  EXPECT_EQ(error_of(counted), wrong_frame_size);
  counted.rest.assign(vertices, {0, 0, 0});
  counted.rest[6][1] = std::nan("");
  EXPECT_EQ(error_of(counted), non_finite_coordinate);
}

TEST(CountedPairs, WrongListsAreRefusedByName) {
  using enum InputError;
  EXPECT_EQ(error_with([](auto& c) { c.triangle_pairs = {{0, 3}}; }), index_out_of_range);
  EXPECT_EQ(error_with([](auto& c) { c.triangle_pairs = {{1, 1}}; }), wrong_relation);
  EXPECT_EQ(error_with([](auto& c) {
              c.vertex_faces = {{4, 0}};
            }),
            wrong_relation)
      << "in a relation of triangles";
  const auto of_features = [](const auto& change) {
    return error_with(change, CountedLevel::features);
  };
  EXPECT_EQ(of_features([](auto& c) {
              c.triangle_pairs = {{0, 2}};
            }),
            wrong_relation)
      << "in a relation of features";
  EXPECT_EQ(of_features([](auto& c) { c.vertex_faces = {{7, 0}}; }), index_out_of_range);
  EXPECT_EQ(of_features([](auto& c) { c.vertex_faces = {{0, 3}}; }), index_out_of_range);
  EXPECT_EQ(of_features([](auto& c) { c.edge_pairs = {{{0, 1}, {4, 7}}}; }), index_out_of_range);
  EXPECT_EQ(of_features([](auto& c) {
              c.edge_pairs = {{{0, 1}, {3, 4}}};
            }),
            wrong_relation)
      << "no such edge";
}

// A state knows nothing of components that nothing is looked for in, and of the rest of a relation
// it is independent.
TEST(CountedPairs, AStateIsOfTheBodiesThatMeetThemselves) {
  const auto make = [](const CountedPairs* counted) {
    auto detector = Detector::create(triangles, places(), {.counted = counted});
    EXPECT_TRUE(detector.has_value());
    EXPECT_EQ(detector.value().step(places(), places()).answer, Answer::free);
    return std::move(detector.value());
  };
  CountedPairs rings, cloth_alone, both_alone;
  rings.rings = 2;
  cloth_alone.body = {0, 0, 0, 0, 1, 1, 1};
  cloth_alone.apart = {{0, 0}};
  both_alone.apart = {{0, 0}};
  Detector every = make(nullptr), ringed = make(&rings), alone = make(&cloth_alone);
  EXPECT_FALSE(every.restore(ringed.state()));
  EXPECT_FALSE(ringed.restore(every.state()));
  for (Detector* other : {&every, &ringed}) {
    ASSERT_TRUE(alone.restore(other->state()));
    EXPECT_EQ(alone.restore(other->state())->error, InputError::foreign_state);
    EXPECT_EQ(other->restore(alone.state())->error, InputError::foreign_state);
  }
  EXPECT_EQ(make(&both_alone).restore(alone.state())->error, InputError::foreign_state);
  EXPECT_FALSE(make(&cloth_alone).restore(alone.state()));
}

}  // namespace
}  // namespace assay::detector
