// The moves of the search: each changes cases and keeps them valid.
#include "properties/search/moves.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"
#include "properties/generators/draft.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "properties/search/search.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

Candidate candidate_of(corpus::Case c, Random& random) {
  Candidate made{std::move(c), {}};
  const auto truth = judge_case(made.c, Contract{});
  made.focus = focus_of(made.c, truth, Contract{}, random);
  return made;
}

// A small case of a family.
corpus::Case case_number(int i) {
  constexpr Eigen::Index most_triangles = 16;
  const auto known = families();
  const auto& family = known[static_cast<std::size_t>(i) % known.size()];
  for (int other = 0;; ++other) {
    corpus::Case c = make_case(family, fmt::format("moves:{}:{}", i, other)).c;
    if (c.triangles.rows() <= most_triangles) return c;
  }
}

TEST(Moves, KeepCasesValidAndChangeThem) {
  const Contract contract;
  for (const Move& move : moves()) {
    int changed = 0;
    for (int i = 0; i < 8 * static_cast<int>(families().size()); ++i) {
      Random random("moves:" + std::to_string(i));
      Candidate made = candidate_of(case_number(i), random);
      const Candidate other = candidate_of(case_number(i + 1), random), before = made;
      move.make(random, made, {contract, &other});
      ASSERT_TRUE(is_valid(made.c)) << move.name << " " << i;
      changed += corpus::case_text(made.c) == corpus::case_text(before.c) ? 0 : 1;
    }
    EXPECT_GE(changed, 15) << move.name;
  }
}

TEST(Moves, OfFeaturesLeaveAQueryAQuery) {
  Contract contract;
  contract.coordinates = Coordinates::float32;
  for (const Move& move : moves()) {
    if (move.kind != MoveKind::features) continue;
    for (std::uint64_t i = 0; i < 40; ++i) {
      Random random("queries:" + std::to_string(i));
      Candidate made =
          candidate_of(case_of_query(query_generators()[0].make(3, i).query, "q"), random);
      const Candidate other =
          candidate_of(case_of_query(query_generators()[0].make(3, i + 2).query, "q"), random);
      move.make(random, made, {contract, &other});
      EXPECT_TRUE(query_of(made.c)) << move.name << " " << i;
    }
  }
}

TEST(Moves, ATetrahedronIsClosedAndClean) {
  int clean = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto query = query_generators()[8].make(9, i).query;
    const auto c = tetrahedron(query, "tetrahedron");
    ASSERT_TRUE(is_valid(c)) << i;
    ASSERT_TRUE(oracle::closes(c.triangles, detector::Triangles(0, 3))) << i;
    const auto layers =
        oracle::layers_at(oracle::Instant(c.frames[0]), c.triangles, detector::Triangles(0, 3));
    clean += std::all_of(layers.clean.begin(), layers.clean.end(),
                         [](std::uint8_t one) { return one != 0; })
                 ? 1
                 : 0;
  }
  EXPECT_EQ(clean, 40);
}

TEST(Moves, TwoTrianglesHoldTheFeaturesOfTheQuery) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    Random random("pair:" + std::to_string(i));
    const auto query = query_generators()[1].make(9, i).query;
    const auto c = two_triangles(query, random, "pair");
    ASSERT_TRUE(is_valid(c)) << i;
    const Focus focus{0, {0, 1, 2, 3}, query.first_group, 0, {}, {}};
    const auto held = query_at(c, focus);
    for (std::size_t p = 0; p < 4; ++p) {
      EXPECT_EQ(held.points[p].t0, query.points[p].t0);
      EXPECT_EQ(held.points[p].t1, query.points[p].t1);
    }
    // An exact contact of the query is one of the two triangles.
    EXPECT_FALSE(judge_case(c, Contract{})[0].pairs.empty()) << i;
  }
}

TEST(Moves, APathOfFloatsStaysOne) {
  Contract contract;
  contract.coordinates = Coordinates::float32;
  for (const Move& move : moves()) {
    if (move.name != "ulps" && move.name != "walk") continue;
    for (std::uint64_t i = 0; i < 40; ++i) {
      Random random("floats:" + std::to_string(i));
      Candidate made =
          candidate_of(case_of_query(query_generators()[0].make(3, i).query, "q"), random);
      move.make(random, made, {contract, nullptr});
      for (const auto& frame : made.c.frames)
        EXPECT_EQ(contracted(frame, Coordinates::float32), frame) << move.name << " " << i;
    }
  }
}

}  // namespace
}  // namespace assay::properties
