// The laws of a plug-in: what is wrong in another form of a case alone breaks them, and what its
// claims allow does not.
#include <set>

#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/trials/case_tally.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

FormLaw form_named(std::string_view name) {
  for (const auto& form : form_laws()) {
    if (form.law == name) return form;
  }
  throw std::invalid_argument(std::string(name));
}

corpus::Case curated_mesh(const std::string& name) {
  return corpus::read_case(ASSAY_SOURCE_DIR "/corpus/curated/" + name + ".json").value();
}

class FormCheckOf {
 public:
  explicit FormCheckOf(const std::string& plugin) { test::set_plugin(request_, plugin); }

  FormCheck operator()(std::string_view law, const corpus::Case& c) {
    auto worker = request_.process();
    const auto seen = contracted(c, request_.detector.contract).value();
    const auto run = worker.run(seen, request_.detector.configurations).front();
    return check_in_form(form_named(law), seen, run, request_.detector, worker);
  }

 private:
  CampaignRequest request_ = test::request_of(0);
};

TEST(Forms, AreOfLawsThatAreThereAndEachOnce) {
  std::set<std::string_view> names;
  for (const auto& form : form_laws()) {
    EXPECT_TRUE(law_named(form.law)) << form.law;
    EXPECT_TRUE(names.insert(form.law).second) << form.law;
  }
  EXPECT_EQ(names.size(), 12u);
}

TEST(Forms, OfARightDetectorHoldAndDifferInNothing) {
  FormCheckOf check(test::plugin("wrapped_builtin"));
  LawCount sum;
  std::set<std::string_view> met;
  for (const auto& form : form_laws()) {
    for (const char* name : {"C1_lost_plus_plus", "D8_release_arm_sequence", "A3_nonstrict_end"}) {
      const auto found = check(form.law, curated_mesh(name));
      EXPECT_FALSE(found.failure) << form.law << " of " << name << ": "
                                  << found.failure->explanation;
      EXPECT_EQ(found.count.differs, 0u) << form.law << " of " << name;
      if (found.count.premise > 0) met.insert(form.law);
      sum += found.count;
    }
  }
  EXPECT_EQ(met.size(), form_laws().size());
  EXPECT_GE(sum.premise, 30u);
}

// The contact at the end of a step is there at the start of the step back, where this detector sees
// it, and the other way round.
TEST(Forms, AContactThatOnlyTheWayBackMissesBreaksTheLaw) {
  FormCheckOf check(test::plugin("fault_elementary_end-excluded"));
  corpus::Case c;
  c.id = "touches:at:start:0";
  c.triangles.resize(2, 3);
  c.triangles << 0, 1, 2, 3, 4, 5;
  detector::Positions x(6, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 1, 1, 5, 2, 1, 5;
  c.frames = {x, x};
  c.frames[1].bottomRows(3).col(2).array() += 3;
  const auto found = check("Change_StepReversed", c);
  EXPECT_EQ(found.count, (LawCount{1, 0, 1, {}, 1}));
  ASSERT_TRUE(found.failure);
  EXPECT_TRUE(found.failure->signature.starts_with(
      "law Change_StepReversed, free-sound: answered free, vertex-face"))
      << found.failure->signature;
  EXPECT_TRUE(found.failure->configuration.ends_with(", law Change_StepReversed"));
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
  constexpr Eigen::Index count = 95;
  corpus::Case c;
  c.triangles.resize(count, 3);
  detector::Positions x(3 * count, 3);
  for (Eigen::Index t = 0; t < count; ++t) {
    c.triangles.row(t) << static_cast<int>(3 * t), static_cast<int>(3 * t + 1),
        static_cast<int>(3 * t + 2);
    const double away = 100. * static_cast<double>(t);
    x.middleRows(3 * t, 3) << away, 0, 0, away + 4, 0, 0, away, 4, 0;
  }
  x.middleRows(3, 3) << 1, 1, -1, 1, 1, 3, 1, 2, 3;
  c.frames = {x, x};
  int broken = 0;
  for (int n = 0; n < 100 && broken == 0; ++n) {
    c.id = "refined:1:closed-generic:" + std::to_string(n);
    const auto form = refined(c);
    if (!form || form->c.triangles.rows() != 97) continue;
    const auto found = check("L18_RefinedMeshHasTheSameContacts", c);
    ASSERT_TRUE(found.failure);
    EXPECT_TRUE(found.failure->signature.starts_with("law L18_RefinedMeshHasTheSameContacts, free"))
        << found.failure->signature;
    ++broken;
  }
  EXPECT_EQ(broken, 1);
}

// Its second intervals are wider. That its claims allow, but not who claims to be deterministic.
TEST(Forms, OtherAnswersToTheSameCallsAreNotDeterministic) {
  const auto c = curated_mesh("C1_lost_plus_plus");
  ::setenv("ASSAY_BY_CONTRACT", "claims=127 changing", 1);
  const auto claimed = FormCheckOf(test::plugin("by_contract"))("Change_EvaluateChangesNothing", c);
  ::setenv("ASSAY_BY_CONTRACT", "claims=63 changing", 1);
  FormCheckOf modest(test::plugin("by_contract"));
  const auto not_claimed = modest("Change_EvaluateChangesNothing", c);
  ::unsetenv("ASSAY_BY_CONTRACT");
  ASSERT_TRUE(claimed.failure);
  EXPECT_EQ(claimed.failure->signature,
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
  auto store = Store::open(scratch / "store", "b").value();
  const auto end = run_trials(request, store, test::in_ten_minutes(), {});
  EXPECT_TRUE(end.complete) << end.harness_problem;
  Tally tally;
  store.for_each_trial([&](const TrialRecord& r) { tally.add(r); });
  const auto laws = laws_in(tally.counts, false);
  ASSERT_EQ(laws.size(), 13u);
  std::uint64_t premises = 0;
  for (const auto& [law, count] : laws) {
    EXPECT_EQ(count.broken + count.differs, 0u) << law->name;
    premises += count.premise;
  }
  EXPECT_GT(premises, 40u);
  EXPECT_TRUE(store.failures().empty());
}

}  // namespace
}  // namespace assay::properties
