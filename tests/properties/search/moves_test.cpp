// The moves of the search: each move changes cases, and keeps them valid.
#include "properties/search/moves.h"

#include <fmt/format.h>

#include "oracle/instant/layers.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/generators/draft.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "properties/search/search.h"
#include "properties/worker/plugin/query_case.h"
#include "tests/test.h"

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

// A path of floats stays one.
TEST(Moves, OfFeaturesLeaveAQueryAQuery) {
  const Contract contract{.coordinates = Coordinates::float32};
  const auto asked = [](std::uint64_t i, Random& random) {
    return candidate_of(case_of_query(query_families()[0].query(3, i).query, "q"), random);
  };
  for (const Move& move : moves()) {
    if (move.kind != MoveKind::features) continue;
    for (std::uint64_t i = 0; i < 40; ++i) {
      Random random("queries:" + std::to_string(i));
      Candidate made = asked(i, random);
      const Candidate other = asked(i + 2, random);
      move.make(random, made, {contract, &other});
      EXPECT_TRUE(query_of(made.c)) << move.name << " " << i;
      if (move.name != "ulps" && move.name != "walk") continue;
      for (const auto& frame : made.c.frames)
        EXPECT_EQ(round_to(frame, Coordinates::float32), frame) << move.name << " " << i;
    }
  }
}

TEST(Moves, ATetrahedronIsClosedAndClean) {
  const detector::Triangles none(0, 3);
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto c = tetrahedron(query_families()[8].query(9, i).query, "tetrahedron");
    ASSERT_TRUE(is_valid(c)) << i;
    ASSERT_TRUE(oracle::closes(c.triangles, none)) << i;
    const auto layers = oracle::layers_at(oracle::Instant(c.frames[0]), c.triangles, none);
    EXPECT_EQ(std::count(layers.clean.begin(), layers.clean.end(), 0), 0) << i;
  }
}

TEST(Moves, TwoTrianglesHoldTheFeaturesOfTheQuery) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    Random random("pair:" + std::to_string(i));
    const auto query = query_families()[1].query(9, i).query;
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

// Whether what meets first is seen alike, and the moves that lead there.

// Two triangles that share a vertex, one behind the other on the ray from the origin along z. A
// corner of the nearer one goes through the farther one; both face away from the origin.
corpus::Case two_layers() {
  corpus::Case c;
  c.triangles.resize(2, 3);
  c.triangles << 0, 2, 1, 0, 3, 4;
  c.frames.assign(2, detector::Positions(5, 3));
  c.frames[0] << 9, 0, 3, 0, 0, 1, 1, 3, 1, -4, 4, 3, -4, -4, 3;
  c.frames[1] = c.frames[0];
  c.frames[1](1, 2) = 5;
  c.view.emplace();
  c.view->q0.assign(2, {0, 0, 0});
  return c;
}

Focus focus_in(const corpus::Case& c) {
  Random random("focus");
  return *focus_of(c, judge_case(c, Contract{}), Contract{}, random);
}
double alike_after(const std::function<void(corpus::Case&)>& change) {
  auto c = two_layers();
  change(c);
  return seen_alike(c, focus_in(c));
}

TEST(SeenAlike, IsOneForTwoLayersSeenFromBehind) {
  const Focus focus = focus_in(two_layers());
  ASSERT_EQ(focus.pairs, (std::vector<detector::TrianglePair>{{0, 1}}));
  EXPECT_TRUE(is_within_a_component(two_layers(), focus));
  EXPECT_EQ(alike_after([](auto&) {}), 1);
  EXPECT_EQ(alike_after([](auto& c) { c.view->q1.assign(2, {0.25, 0.25, 0}); }), 1) << "by a line";
}

TEST(SeenAlike, IsLessWhereATriangleIsTurnedOrTurnsOnItsWayAndZeroWithoutAView) {
  EXPECT_EQ(alike_after([](auto& c) { c.triangles.row(1) << 0, 4, 3; }), 0);
  EXPECT_EQ(alike_after([](auto& c) { c.view.reset(); }), 0);
  const double alike = alike_after([](auto& c) { c.frames[1].row(2) << 1, -3, 1; });
  EXPECT_GT(alike, 0.3);
  EXPECT_LT(alike, 1);
}

TEST(SeenAlike, IsAskedWithinAComponent) {
  auto c = two_layers();
  c.triangles.row(0) << 5, 2, 1;
  for (auto& frame : c.frames) {
    frame.conservativeResize(6, 3);
    frame.row(5) << 9, 0.5, 3;
  }
  const Focus focus = focus_in(c);
  ASSERT_FALSE(focus.pairs.empty());
  EXPECT_FALSE(is_within_a_component(c, focus));
}

// L3: in a clean closed mesh some pair that meets first is not of one sign.
TEST(SeenAlike, L3_IsLessInACleanClosedMesh) {
  int met = 0;
  double most = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(fmt::format("alike:{}", i));
    auto c = tetrahedron(query_families()[8].query(9, i).query, "tetrahedron");
    const auto truth = judge_case(c, Contract{});
    if (truth[0].pairs.empty() || truth[0].first.lo == 0) continue;
    ++met;
    Candidate made{c, focus_of(c, truth, Contract{}, random)};
    for (const Move& move : view_moves()) {
      if (move.name != "gaze" && move.name != "view") continue;
      move.make(random, made, {Contract{}});
      const double alike = seen_alike(made.c, *made.focus);
      EXPECT_LT(alike, 1) << i << " " << move.name;
      most = std::max(most, alike);
    }
  }
  EXPECT_GE(met, 30);
  EXPECT_GT(most, 0.75);
}

// Whatever went before it, the step in focus is the same, or a part of it, seen from the same
// place.
TEST(Past, KeepsTheStepInFocus) {
  const Contract contract;
  auto before = two_layers();
  before.view->q0[1] = {0.5, 0, 0};
  const Focus focus = focus_in(before);
  const auto query = query_at(before, focus);
  const auto past = std::find_if(moves().begin(), moves().end(),
                                 [](const Move& move) { return move.name == "past"; });
  int kept = 0, parts = 0;
  for (int i = 0; i < 100; ++i) {
    Random random(fmt::format("past:{}", i));
    Candidate made{before, focus};
    past->make(random, made, {contract});
    if (!made.focus) continue;
    const auto now = query_at(made.c, *made.focus);
    const auto view = corpus::view_of_step(made.c, made.focus->step)->q0;
    // Where the features meet, the view is that of this time.
    const double t = made.focus->time;
    EXPECT_DOUBLE_EQ(between(view.t0, view.t1, t)[0], 0.5 * focus.time) << i;
    for (std::size_t p = 0; p < 4; ++p) {
      const auto place = between(now.points[p].t0, now.points[p].t1, t),
                 wanted = between(query.points[p].t0, query.points[p].t1, focus.time);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(place[k], wanted[k]) << i;
    }
    (now.points[0].t0 == query.points[0].t0 && now.points[0].t1 == query.points[0].t1 ? kept
                                                                                      : parts)++;
  }
  EXPECT_GE(kept, 40);
  EXPECT_GE(parts, 5);
}

// Two shells of one component, of which the inner one goes through the outer one.
TEST(SeenAlike, NestedShellsMeetAlongARay) {
  const Contract contract;
  int alike = 0;
  constexpr int all = 100;
  for (std::uint64_t i = 0; i < all; ++i) {
    Random random(fmt::format("nested:{}", i));
    Candidate made{tetrahedron(query_families()[8].query(9, i).query, "tetrahedron"), {}};
    nest(random, made, {contract});
    pass_by_ray(random, made, {contract});
    const auto truth = judge_case(made.c, contract);
    const auto focus = focus_of(made.c, truth, contract, random);
    if (focus && seen_alike(made.c, *focus) == 1) ++alike;
  }
  EXPECT_GE(alike, all / 3);
}

}  // namespace
}  // namespace assay::properties
