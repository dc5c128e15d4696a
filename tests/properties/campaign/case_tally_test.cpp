// What is counted for a case: its extremes, such as its greatest sizes, and the laws of a plug-in.
// Such a law is broken by an answer that is wrong only in another form of the case, and not by an
// answer that the claims allow.
#include <csignal>
#include <new>

#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/trials/trials.h"
#include "properties/worker/worker_process.h"
#include "tests/curated_cases.h"
#include "tests/meshes.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

class FormCheckOf {
 public:
  explicit FormCheckOf(const std::string& plugin) { test::set_plugin(request_, plugin); }

  FormCheck operator()(std::string_view law, const corpus::Case& c) {
    auto worker = request_.process();
    const auto seen = contract_case(c, request_.detector.contract).value();
    const auto run = worker.run(seen, request_.detector.configurations).front();
    return check_in_form(*law_named(law), seen, run, request_.detector, worker);
  }

 private:
  CampaignRequest request_ = test::request_of(0);
};

TEST(Forms, OfARightDetectorHoldAndDifferInNothing) {
  FormCheckOf check(test::plugin("wrapped_builtin"));
  LawCount sum;
  std::set<std::string_view> met;
  for (const auto& law : laws()) {
    if (!law.change) continue;
    for (const char* name : {"C1_lost_plus_plus", "D8_release_arm_sequence", "A3_nonstrict_end"}) {
      const auto found = check(law.name, tests::curated_case(name));
      EXPECT_FALSE(found.failure) << law.name << " of " << name << ": "
                                  << found.failure->explanation;
      EXPECT_EQ(found.count.differs, 0u) << law.name << " of " << name;
      if (found.count.premise > 0) met.insert(law.name);
      sum += found.count;
    }
  }
  EXPECT_EQ(met.size(), 12u);
  EXPECT_GE(sum.premise, 30u);
}

// The contact at the end of a step is there at the start of the step back, where this detector sees
// it, and the other way round.
TEST(Forms, AContactThatOnlyTheWayBackMissesBreaksTheLaw) {
  FormCheckOf check(test::plugin("fault_elementary_end-excluded"));
  corpus::Case c;
  c.id = "touches:at:start:0";
  c.triangles = tests::triangles({{0, 1, 2}, {3, 4, 5}});
  c.frames.assign(2, tests::positions_of("0 0 0, 4 0 0, 0 4 0, 1 1 0, 1 1 5, 2 1 5"));
  c.frames[1].bottomRows(3).col(2).array() += 3;
  const auto found = check("Change_StepReversed", c);
  EXPECT_EQ(found.count, (LawCount{1, 0, 1, {}, 1}));
  ASSERT_TRUE(found.failure);
  EXPECT_TRUE(found.failure->signature().starts_with(
      "law Change_StepReversed, free-sound: answered free, vertex-face"))
      << found.failure->signature();
  EXPECT_EQ(found.failure->law, "Change_StepReversed");
  EXPECT_FALSE(found.failure->flaky);
  // What is stored is the form, which is wrong by itself.
  const auto form = corpus::parse_case(found.failure->mesh, "form");
  ASSERT_TRUE(form) << form.error().message;
  EXPECT_EQ(form.value().frames[0], c.frames[1]);
  // The case as it is has nothing of it.
  EXPECT_FALSE(check("Change_Mirror", c).failure);
}

// It answers free on meshes of 97 triangles: one of fewer has as many when an edge is split.
TEST(Forms, AMeshThatFailsWhenItIsRefinedBreaksL18) {
  FormCheckOf check(test::plugin("misses_on_97"));
  // Two triangles that cross, and 93 far away, each alone.
  constexpr int count = 95;
  corpus::Case c;
  c.triangles.resize(count, 3);
  detector::Positions x(3 * count, 3);
  for (int t = 0; t < count; ++t) {
    c.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    x.middleRows(3 * t, 3) << 100 * t, 0, 0, 100 * t + 4, 0, 0, 100 * t, 4, 0;
  }
  x.middleRows(3, 3) << 1, 1, -1, 1, 1, 3, 1, 2, 3;
  c.frames = {x, x};
  int broken = 0;
  for (int n = 0; n < 100 && broken == 0; ++n) {
    c.id = "refined:1:closed-generic:" + std::to_string(n);
    const auto form = form_of(changes::split_edges, c);
    if (!form || form->c.triangles.rows() != 97) continue;
    const auto found = check("L18_RefinedMeshHasTheSameContacts", c);
    ASSERT_TRUE(found.failure);
    EXPECT_TRUE(
        found.failure->signature().starts_with("law L18_RefinedMeshHasTheSameContacts, free"))
        << found.failure->signature();
    ++broken;
  }
  EXPECT_EQ(broken, 1);
}

// Its second intervals are wider. That its claims allow, but not who claims to be deterministic.
TEST(Forms, OtherAnswersToTheSameCallsAreNotDeterministic) {
  const auto c = tests::curated_case("C1_lost_plus_plus");
  ::setenv("ASSAY_BY_CONTRACT", "claims=127 changing", 1);
  const auto claimed = FormCheckOf(test::plugin("by_contract"))("Change_EvaluateChangesNothing", c);
  ::setenv("ASSAY_BY_CONTRACT", "claims=63 changing", 1);
  FormCheckOf modest(test::plugin("by_contract"));
  const auto not_claimed = modest("Change_EvaluateChangesNothing", c);
  ::unsetenv("ASSAY_BY_CONTRACT");
  ASSERT_TRUE(claimed.failure);
  EXPECT_EQ(claimed.failure->signature(),
            "law Change_EvaluateChangesNothing, deterministic: two runs differ");
  EXPECT_TRUE(claimed.failure->flaky);
  EXPECT_FALSE(not_claimed.failure);
  EXPECT_EQ(not_claimed.count.broken, 0u);
  EXPECT_GT(not_claimed.count.differs, 0u);
}

// The trials of a plug-in count its laws, and store what breaks them as failures that are no
// defects of trials.
TEST(Forms, AreCountedWithTheTrials) {
  auto request = test::request_of(200, 2);
  request.plan.laws_every = 1;
  test::set_plugin(request, test::plugin("wrapped_builtin"));
  const tests::Scratch scratch;
  const auto store = test::with_all_trials(request, scratch / "store");
  const auto laws = laws_in(test::tally_in(store).counts, false);
  ASSERT_EQ(laws.size(), 13u);
  std::uint64_t premises = 0;
  for (const auto& [law, count] : laws) {
    EXPECT_EQ(count.broken + count.differs, 0u) << law->name;
    premises += count.premise;
  }
  EXPECT_GT(premises, 40u);
  EXPECT_TRUE(store.failures().empty());
}

// How far a case goes, told of cases that are known by heart.

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
  // Pairs are those of the fullest step.
  std::vector<oracle::StepJudgement> truth(3);
  truth[0].pairs.resize(2);
  truth[1].pairs.resize(7);
  EXPECT_EQ(extremes_of(fan_and_triangle(4), truth).pairs, 7u);
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

// A crash inside a law is a broken law, and nothing else is lost by it.

const LawTally held{7, 2, 0, ""};

std::vector<LawTally> checks_with(std::size_t count, std::size_t bad,
                                  const std::function<void()>& what_it_does) {
  return check_in_copies(
      count, [](std::size_t) { return "a:1:b:2"; },
      [&](std::size_t i) {
        if (i == bad) what_it_does();
        return held;
      });
}

TEST(LawChecks, ACrashOrAnExitBreaksTheLawAndNoOther) {
  const std::pair<std::function<void()>, const char*> ends[] = {
      {[] { std::abort(); }, "killed by signal 6 (Aborted)"},
      {[] { std::_Exit(0); }, "exited with code 0"},
      {[] { std::_Exit(3); }, "exited with code 3"}};
  for (const auto& [what_it_does, words] : ends) {
    const LawTally broken{1, 0, 1, std::string("a:1:b:2: the check ended: ") + words};
    EXPECT_EQ(checks_with(4, 1, what_it_does), (std::vector<LawTally>{held, broken, held, held}));
  }
}

TEST(LawChecks, NumbersAndWordsArrive) {
  const LawTally broken{1ull << 60, 3, 2, "case \"x\", step 1:\n\xff"};
  const auto tallies = check_in_copies(
      1000, [](std::size_t) { return "c"; },
      [&](std::size_t i) { return i == 998 ? broken : held; });
  ASSERT_EQ(tallies.size(), 1000u);
  EXPECT_EQ(tallies[998].premise, broken.premise);
  EXPECT_TRUE(tallies[998].first_broken.starts_with("case \"x\", step 1:\n"));
  EXPECT_EQ(tallies[999], held);
  EXPECT_TRUE(check_in_copies(0, {}, [](std::size_t) -> LawTally { std::abort(); }).empty());
}

TEST(LawChecks, WhatIsThrownIsThrown) {
  EXPECT_THROW(checks_with(2, 1, [] { throw std::bad_alloc(); }), std::bad_alloc);
  try {
    checks_with(2, 1, [] { throw std::logic_error("no such thing"); });
    FAIL();
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "no such thing");
  }
}

TEST(LawChecks, WhoIsKilledFromOutsideBeginsAgain) {
  // Only a file outlives the copies.
  const tests::Scratch scratch;
  const std::string mark = scratch / "killed once";
  const auto tallies = checks_with(2, 1, [&] {
    if (std::filesystem::exists(mark)) return;
    std::ofstream(mark) << "x";
    std::raise(SIGTERM);
  });
  EXPECT_EQ(tallies, (std::vector<LawTally>{held, held}));
  EXPECT_THROW(checks_with(2, 1, [] { std::raise(SIGKILL); }), std::runtime_error);
}

}  // namespace
}  // namespace assay::properties
