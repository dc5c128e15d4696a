#include "oracle/mesh/step.h"

#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Answer, detector::FeatureKind, detector::PairContact, detector::TimeEnclosure,
    detector::TrianglePair, test::positions, test::Step, test::triangles;

StepJudgement judge(const Step& step, int jobs = 1) {
  return judge_step({step.x_t0, step.x_t1}, step.f, {jobs, {}});
}

// Times to the digits that the cases state.
using Times = std::map<TrianglePair, double>;

void expect_pairs(const StepJudgement& judgement, const Times& expected) {
  ASSERT_TRUE(judgement.complete);
  EXPECT_EQ(judgement.answer, expected.empty() ? Answer::free : Answer::collision);
  ASSERT_EQ(judgement.pairs.size(), expected.size());
  double least = 2;
  auto want = expected.begin();
  for (const PairContact& contact : judgement.pairs) {
    EXPECT_EQ(contact.pair, want->first);
    EXPECT_NEAR(contact.time.lo, want->second, 1e-8);
    least = std::min(least, contact.time.lo);
    ++want;
  }
  EXPECT_TRUE(expected.empty() || judgement.first.lo == least);
}

bool same_bytes(const StepJudgement& a, const StepJudgement& b) {
  return a.answer == b.answer && a.complete == b.complete && a.first == b.first &&
         a.feature_candidates == b.feature_candidates && a.rungs == b.rungs &&
         test::same(a.pairs, b.pairs);
}

Step tetrahedron(const detector::Point& top_t0, const detector::Point& top_t1) {
  return {positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, top_t0}),
          positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, top_t1}), test::tetrahedron_triangles};
}

TEST(JudgeStep, WithoutAContactIsFree) {
  Step resting = tetrahedron({1, 1, 3}, {1, 1, 3});
  expect_pairs(judge(resting), {});
  expect_pairs(judge({positions({}), positions({}), triangles({})}), {});
  // A vertex of no triangle, in a face.
  for (detector::Positions* x : {&resting.x_t0, &resting.x_t1}) {
    x->conservativeResize(5, 3);
    x->row(4) << 1, 1, 0;
  }
  expect_pairs(judge(resting), {});
  const auto fan = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-4, 0, 0}, {0, -4, 0}});
  expect_pairs(judge({fan, fan, triangles({{0, 1, 2}, {0, 3, 4}})}), {});
}

TEST(JudgeStep, PokedTetrahedron) {
  // The top passes through the base: three pairs, each sharing an edge, one feature contact.
  const StepJudgement judgement = judge(tetrahedron({1, 1, 3}, {1, 1, -1}));
  expect_pairs(judgement, {{{0, 1}, 0.75}, {{0, 2}, 0.75}, {{0, 3}, 0.75}});
  EXPECT_EQ(judgement.first, (TimeEnclosure{0.75, 0.75}));
  for (const PairContact& contact : judgement.pairs) {
    EXPECT_EQ(contact.feature.kind, FeatureKind::vertex_face);
    EXPECT_EQ(contact.feature.vertices, (std::array<std::int32_t, 5>{3, 0, 2, 1, -1}));
  }
}

TEST(JudgeStep, PairThatSharesAnEdgeFolds) {
  // A sheet of two triangles folded flat upon itself at t=1: they meet beyond the shared edge.
  const Step step = {positions({{0, 0, 0}, {4, 0, 0}, {2, 4, 0}, {2, -4, 0}}),
                     positions({{0, 0, 0}, {4, 0, 0}, {2, 4, 0}, {2, 4, 0}}),
                     triangles({{0, 1, 2}, {1, 0, 3}})};
  // In one plane throughout; vertex 3 first touches the edge 01 of the other triangle at t=1/2.
  expect_pairs(judge(step), {{{0, 1}, 0.5}});
}

TEST(JudgeStep, PairThatSharesAVertex) {
  const Step step = {positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 2}, {2, 1, 2}}),
                     positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -2}, {2, 1, 1}}),
                     triangles({{0, 1, 2}, {0, 3, 4}})};
  expect_pairs(judge(step), {{{0, 1}, 0.5}});
}

TEST(JudgeStep, PiercingAtTheStart) {
  // The edge 34 is through the inside of the first triangle and nothing moves.
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 9}});
  const StepJudgement judgement = judge({x, x, triangles({{0, 1, 2}, {3, 4, 5}})});
  expect_pairs(judgement, {{{0, 1}, 0}});
  EXPECT_EQ(judgement.pairs[0].feature.kind, FeatureKind::piercing);
  EXPECT_EQ(judgement.pairs[0].feature.vertices, (std::array<std::int32_t, 5>{3, 4, 0, 1, 2}));
}

TEST(JudgeStep, SameThreeVertices) {
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  const StepJudgement judgement = judge({x, x, triangles({{0, 1, 2}, {2, 1, 0}, {1, 2, 0}})});
  expect_pairs(judgement, {{{0, 1}, 0}, {{0, 2}, 0}, {{1, 2}, 0}});
  EXPECT_EQ(judgement.pairs[1].feature.kind, FeatureKind::same_vertices);
}

TEST(JudgeStep, TurningTetrahedron) {
  expect_pairs(judge(test::turning_tetrahedron()),
               {{{0, 1}, 0.489921562}, {{0, 2}, 0.4}, {{0, 3}, 0.4}, {{1, 2}, 0.4}, {{1, 3}, 0.4}});
}

TEST(JudgeStep, CollapsingOctahedron) {
  Times times;
  const auto rows = tests::positions_of(
      "0 2 .40179328, 0 3 .40179328, 0 4 .952755811, 0 6 .40179328, 0 7 .40179328, "
      "1 4 .645102508, 1 6 .426479047, 1 7 .426479047, 2 4 .645102508, 2 6 .426479047, "
      "2 7 .426479047, 4 5 .645102508, 4 6 .645102508, 6 7 .858057737");
  for (const auto& row : rows.rowwise())
    times[{static_cast<int>(row[0]), static_cast<int>(row[1])}] = row[2];
  expect_pairs(judge(test::collapsing_octahedron()), times);
}

TEST(JudgeStep, IntersectingOctahedron) {
  const StepJudgement judgement = judge(test::intersecting_octahedron());
  expect_pairs(judgement, {{{0, 2}, 0}, {{0, 6}, 0}, {{2, 4}, 0.125}, {{4, 6}, 0}});
  EXPECT_EQ(judgement.pairs[0].feature.kind, FeatureKind::piercing);
  EXPECT_EQ(judgement.pairs[2].feature.kind, FeatureKind::edge_edge);
}

TEST(JudgeStep, TrianglesOnAnEdgeOfThree) {
  // Three triangles at one edge; a vertex of a fourth crosses one of them at the common edge.
  const Step step = {
      tests::positions_of("0 -2 0, 0 2 0, 3 0 0, -3 0 0, 0 0 3, -1 0 -1, -2 0 -5, 2 0 -5"),
      tests::positions_of("0 -2 0, 0 2 0, 3 0 0, -3 0 0, 0 0 3, 1 0 1, -2 0 -5, 2 0 -5"),
      triangles({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {5, 6, 7}})};
  expect_pairs(judge(step), {{{0, 3}, 0.5}, {{1, 3}, 0.5}, {{2, 3}, 0.5}});
}

Step random_soup(std::uint64_t seed, int vertices, int faces) {
  test::Random random(seed);
  Step step;
  step.x_t0.resize(vertices, 3);
  step.x_t1.resize(vertices, 3);
  for (Eigen::Index i = 0; i < step.x_t0.size(); ++i) {
    const double x = step.x_t0.data()[i] = random.integer(6);
    step.x_t1.data()[i] = x + random.integer(2);
  }
  step.f = random_triangles(random, vertices, faces);
  return step;
}

// All features of all triangle pairs, one pair after the other.
Times brute_force(const Step& step) {
  Times times;
  auto path = [&](int v) { return detector::SteppedMesh{step.x_t0, step.x_t1}.path(v); };
  auto start = [&](int v) { return detector::point_of(step.x_t0, v); };
  for (int a = 0; a < step.f.rows(); ++a) {
    for (int b = a + 1; b < step.f.rows(); ++b) {
      double least = 2;
      auto note = [&](const ContactAnswer& c) {
        if (c.contact) least = std::min(least, c.first.lo);
      };
      for (const auto& [s, t] : {std::pair(a, b), std::pair(b, a)}) {
        const Eigen::RowVector3i f = step.f.row(s), g = step.f.row(t);
        auto held = [&](int v) { return g[0] == v || g[1] == v || g[2] == v; };
        for (int i = 0; i < 3; ++i) {
          const int v = f[i], w = f[(i + 1) % 3];
          if (!held(v)) {
            note(vertex_face_contact({path(v), {path(g[0]), path(g[1]), path(g[2])}},
                                     detector::Want::first_time));
          }
          if (!held(v) && !held(w) &&
              segment_pierces_triangle(start(v), start(w),
                                       {start(g[0]), start(g[1]), start(g[2])})) {
            least = 0;
          }
          for (int j = 0; j < 3; ++j) {
            const int p = g[j], q = g[(j + 1) % 3];
            if (v == p || v == q || w == p || w == q) continue;
            note(edge_edge_contact({{path(v), path(w)}, {path(p), path(q)}},
                                   detector::Want::first_time));
          }
        }
        if (held(f[0]) && held(f[1]) && held(f[2])) least = 0;
      }
      if (least <= 1) times[{a, b}] = least;
    }
  }
  return times;
}

TEST(JudgeStep, BruteForceAgrees) {
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_soup(100 + seed, 14, 12);
    expect_pairs(judge(step), brute_force(step));
  }
}

TEST(JudgeStep, JobsDoNotChangeAByte) {
  const Step step = random_soup(7, 150, 150);
  const StepJudgement one = judge(step, 1);
  for (const int jobs : {0, 2, 3}) EXPECT_TRUE(same_bytes(one, judge(step, jobs))) << jobs;
}

TEST(JudgeStep, TimeReversalKeepsTheSweptPairs) {
  // Of steps that start and end without piercing.
  Step step = test::turning_tetrahedron();
  const StepJudgement forward = judge(step);
  std::swap(step.x_t0, step.x_t1);
  const StepJudgement back = judge(step);
  for (const PairContact& c : forward.pairs)
    EXPECT_TRUE(std::any_of(back.pairs.begin(), back.pairs.end(),
                            [&](const PairContact& d) { return d.pair == c.pair; }));
}

TEST(JudgeStep, StoppedAtOnce) {
  const Step step = random_soup(8, 200, 200);
  const StepJudgement judgement =
      judge_step({step.x_t0, step.x_t1}, step.f, {2, [] { return true; }});
  EXPECT_EQ(judgement.answer, Answer::undecided);
  EXPECT_FALSE(judgement.complete);
}

TEST(JudgeStep, StoppedLaterKeepsWhatItFound) {
  const Step step = random_soup(9, 300, 300);
  const StepJudgement whole = judge(step);
  int calls = 0;
  const StepJudgement part =
      judge_step({step.x_t0, step.x_t1}, step.f, {1, [&] { return ++calls > 3; }});
  EXPECT_EQ(part.answer, Answer::undecided);
  EXPECT_FALSE(part.complete);
  EXPECT_LT(part.pairs.size(), whole.pairs.size());
  for (const PairContact& c : part.pairs)
    EXPECT_TRUE(std::binary_search(whole.pairs.begin(), whole.pairs.end(), c,
                                   [](const auto& x, const auto& y) { return x.pair < y.pair; }));
}

TEST(JudgeStep, ExceptionOfTheStopFunctionComesThrough) {
  const Step step = random_soup(8, 50, 50);
  EXPECT_THROW(judge_step({step.x_t0, step.x_t1}, step.f,
                          {2, []() -> bool { throw std::runtime_error("stop"); }}),
               std::runtime_error);
}

}  // namespace
}  // namespace assay::oracle
