// The second opinion finds no contradiction if the judgement is right, and one if the judgement is
// wrong.
#include "oracle/referee/second_opinion.h"

#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using test::Step;

StepJudgement judge(const Step& step) { return judge_step({step.x_t0, step.x_t1}, step.f, {}); }

SecondOpinion ask(const Step& step, const StepJudgement& judgement, double share = 1,
                  int jobs = 1) {
  return second_opinion({step.x_t0, step.x_t1}, step.f, judgement, {share, jobs, {}});
}

// A bumpy sheet, one half of which folds into the other: n x n squares.
Step folding_sheet(int n, std::uint64_t seed) {
  test::Random random(seed);
  Step step;
  step.x_t0.resize((n + 1) * (n + 1), 3);
  step.x_t1.resize((n + 1) * (n + 1), 3);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const int v = i * (n + 1) + j;
      const double x = i - n / 2.0, bump = 0.2 * random.unit();
      step.x_t0.row(v) << x, j, bump;
      step.x_t1.row(v) << std::fabs(x), j + 0.3 * random.unit(), 0.4 * random.unit();
    }
  }
  step.f = tests::sheet_triangles(n + 1);
  return step;
}

TEST(SecondOpinion, AgreesOnSmallMeshes) {
  for (const Step& step :
       {test::turning_tetrahedron(), test::collapsing_octahedron(), test::intersecting_octahedron(),
        test::seven_vertices_about_a_line(), folding_sheet(8, 61)}) {
    const StepJudgement judgement = judge(step);
    const SecondOpinion opinion = ask(step, judgement);
    EXPECT_TRUE(opinion.complete);
    EXPECT_EQ(opinion.queries, judgement.feature_candidates);
    EXPECT_EQ(opinion.queries, opinion.contact + opinion.no_contact + opinion.open);
    EXPECT_GT(opinion.static_checks, 0u);
    EXPECT_TRUE(opinion.contradictions.empty());
  }
}

TEST(SecondOpinion, AMissingPairIsReported) {
  for (const Step& step : {test::collapsing_octahedron(), folding_sheet(5, 62)}) {
    const StepJudgement right = judge(step);
    ASSERT_FALSE(right.pairs.empty());
    const std::size_t stride = right.pairs.size() / 10 + 1;
    for (std::size_t lost = 0; lost < right.pairs.size(); lost += stride) {
      StepJudgement wrong = right;
      const detector::TrianglePair pair = right.pairs[lost].pair;
      wrong.pairs.erase(wrong.pairs.begin() + static_cast<std::ptrdiff_t>(lost));
      const SecondOpinion opinion = ask(step, wrong);
      ASSERT_FALSE(opinion.contradictions.empty()) << pair.a << " " << pair.b;
      for (const Contradiction& c : opinion.contradictions) {
        EXPECT_TRUE(c.kind == ContradictionKind::missing_pair ||
                    c.kind == ContradictionKind::static_pair);
        EXPECT_EQ(c.pair, pair);
        EXPECT_FALSE(c.judged);
        EXPECT_TRUE(c.second);
      }
    }
  }
}

TEST(SecondOpinion, WrongTimesAreReported) {
  const Step step = test::intersecting_octahedron();
  const StepJudgement right = judge(step);
  const auto starts = std::find_if(right.pairs.begin(), right.pairs.end(), [](const auto& p) {
    return p.time == detector::TimeEnclosure{0, 0};
  });
  ASSERT_NE(starts, right.pairs.end());
  StepJudgement late = right;
  late.pairs[static_cast<std::size_t>(starts - right.pairs.begin())].time = {.5, .5};
  const SecondOpinion found = ask(step, late);
  ASSERT_FALSE(found.contradictions.empty());
  EXPECT_EQ(found.contradictions[0].kind, ContradictionKind::static_late);

  const Step other = test::collapsing_octahedron();
  StepJudgement early = judge(other);
  ASSERT_FALSE(early.pairs.empty());
  early.pairs[0].time = {0, 0};
  const SecondOpinion apart = ask(other, early);
  ASSERT_FALSE(apart.contradictions.empty());
  EXPECT_EQ(apart.contradictions[0].kind, ContradictionKind::static_apart);
}

TEST(SecondOpinion, SameForAnyJobsAndShareIsKept) {
  const Step step = folding_sheet(8, 63);
  StepJudgement wrong = judge(step);
  ASSERT_GT(wrong.pairs.size(), 10u);
  wrong.pairs.resize(wrong.pairs.size() / 2);
  const SecondOpinion all = ask(step, wrong);
  double last = 0;
  for (const double share : {0.1, 0.5, 1.0}) {
    const SecondOpinion one = ask(step, wrong, share, 1), three = ask(step, wrong, share, 3);
    EXPECT_EQ(one.queries, three.queries);
    EXPECT_EQ(one.contact, three.contact);
    EXPECT_EQ(one.open, three.open);
    EXPECT_EQ(one.static_checks, three.static_checks);
    ASSERT_EQ(one.contradictions.size(), three.contradictions.size());
    for (std::size_t i = 0; i < one.contradictions.size(); ++i) {
      EXPECT_EQ(one.contradictions[i].kind, three.contradictions[i].kind);
      EXPECT_EQ(one.contradictions[i].pair, three.contradictions[i].pair);
      EXPECT_EQ(one.contradictions[i].feature.vertices, three.contradictions[i].feature.vertices);
    }
    const double measured = static_cast<double>(one.queries) / static_cast<double>(all.queries);
    EXPECT_NEAR(measured, share, 0.05);
    EXPECT_GT(measured, last);
    last = measured;
  }
}

TEST(SecondOpinion, StopsAndSaysSo) {
  const Step step = folding_sheet(12, 64);
  const StepJudgement judgement = judge(step);
  std::atomic<int> calls = 0;
  const SecondOpinion opinion = second_opinion({step.x_t0, step.x_t1}, step.f, judgement,
                                               {1, 2, [&] { return ++calls > 1; }});
  EXPECT_FALSE(opinion.complete);
  EXPECT_TRUE(opinion.contradictions.empty());
}

TEST(SecondOpinion, AStoppedJudgementLacksNothing) {
  const Step step = test::collapsing_octahedron();
  StepJudgement part = judge(step);
  part.complete = false;
  part.pairs.clear();
  const SecondOpinion opinion = ask(step, part);
  EXPECT_TRUE(opinion.contradictions.empty());
  EXPECT_GT(opinion.contact, 0u);
  EXPECT_EQ(opinion.static_checks, 0u);
}

}  // namespace
}  // namespace assay::oracle
