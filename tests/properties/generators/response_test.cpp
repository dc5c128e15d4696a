// Responses made explicit: committed steps are free, colliding steps are not committed, and the
// case replays from its own frames.
#include <fmt/format.h>

#include "oracle/mesh/step.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// Vertex 3 of a tetrahedron goes down through the opposite face, which it reaches at t = 1/2.
corpus::Case down_through_the_floor() {
  corpus::Case c;
  c.id = "down-through-the-floor";
  c.triangles = tests::triangles_of("0 2 1, 0 1 3, 1 2 3, 2 0 3");
  c.frames.assign(3, tests::positions_of("0 0 0, 4 0 0, 0 4 0, 1 1 2"));
  c.frames[1](3, 2) = -2;
  c.frames[2](3, 2) = 0;  // the second step goes up by 2
  return c;
}

TEST(Response, ShortensBelowTheContactAndGoesOnFromThere) {
  auto c = down_through_the_floor();
  c.view = corpus::CaseView{{{0, 0, 0}, {4, 0, 0}, {8, 0, 0}}, {}};
  const auto made = with_response(c);
  // Half of the first time is 1/4: down to 1; then up to 3 as the second step is free.
  const std::vector<corpus::CaseStep> wanted = {{0, 1, false}, {0, 2, true}, {2, 3, true}};
  EXPECT_EQ(made.script, wanted);
  ASSERT_EQ(made.frames.size(), 4u);
  EXPECT_EQ(made.frames[1](3, 2), -2);
  EXPECT_EQ(made.frames[2](3, 2), 1);
  EXPECT_EQ(made.frames[3](3, 2), 3);
  // The view primitive moves by the same part.
  EXPECT_EQ(made.view->q0,
            (std::vector<detector::Point>{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {8, 0, 0}}));
}

TEST(Response, RevertsWhereTheStartIsInContact) {
  auto c = down_through_the_floor();
  for (auto& x : c.frames) x(3, 2) -= 2;  // starts on the floor
  EXPECT_EQ(with_response(c).script, (std::vector<corpus::CaseStep>{{0, 1, false}, {0, 2, false}}));
}

TEST(Response, GeneratedOnesCommitWhatIsFreeAndTheDetectorAgrees) {
  int responses = 0, evaluated = 0, shortened = 0;
  for (const auto& family : families()) {
    for (int i = 0; i < 150; ++i) {
      const auto made = make_case(family, fmt::format("response:1:{}:{}", family.name, i));
      if (made.c.script.empty()) continue;
      SCOPED_TRACE(made.c.id);
      ++responses;
      std::int32_t now = 0;
      for (std::size_t s = 0; s < made.c.script.size(); ++s) {
        const auto& step = made.c.script[s];
        ASSERT_EQ(step.from, now);
        const auto judgement = oracle::judge_step({start_of(made.c, step), end_of(made.c, step)},
                                                  made.c.triangles, {1, {}});
        ASSERT_EQ(judgement.answer == Answer::free, step.commit);
        evaluated += step.commit ? 0 : 1;
        shortened += step.commit && s > 0 && !made.c.script[s - 1].commit ? 1 : 0;
        if (step.commit) now = step.to;
      }
      // The answers of the detector, step by step, state carried as the script says.
      ASSERT_EQ(check_case(made.c, detector::Culling::view_point).verdicts[0].outcome,
                Outcome::holds);
    }
  }
  std::printf("%d cases with a response, %d collisions not committed, %d shortened steps\n",
              responses, evaluated, shortened);
  EXPECT_GT(responses, 60);
  EXPECT_GT(evaluated, 60);
  EXPECT_GT(shortened, 20);
}

}  // namespace
}  // namespace assay::properties
