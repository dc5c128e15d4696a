// The trials of a campaign: they are the same for any number of jobs, they can be resumed, and each
// can be made again by its id. Their failures are stored, replayed and shrunk.
#include "properties/campaign/trials/trials.h"

#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/phases.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using test::faulty, test::in_ten_minutes, test::request_of, tests::Scratch;

class Trials : public testing::Test {
 protected:
  Store open(const std::string& name) const { return test::open_store(scratch / name); }
  Store run(const CampaignRequest& request, const std::string& name = "store") const {
    return test::with_all_trials(request, scratch / name);
  }
  // Each trial in a line, without its times.
  static std::vector<std::string> lines(const Store& store) {
    std::vector<std::string> list;
    store.for_each_trial([&](const TrialRecord& r) {
      list.push_back(r.id + " " + r.family + " " + std::to_string(r.index) + " " +
                     lasting(to_row(r)).fields);
    });
    return list;
  }
  Scratch scratch;
};

TEST_F(Trials, DoNotDependOnJobs) {
  const auto alone = lines(run(request_of(20), "one"));
  ASSERT_EQ(alone.size(), 30u);
  EXPECT_TRUE(says(alone[0], "test:3:broken:0"));
  EXPECT_EQ(lines(run(request_of(20, 3), "three")), alone);
  // Of eight shares seed 3 has the places 3, 11, ... of each family.
  const auto some = lines(run(request_of(20, 2, 8)));
  ASSERT_EQ(some.size(), 5u);
  EXPECT_TRUE(some[0].starts_with("test:3:broken:3 "));
  EXPECT_TRUE(some[1].starts_with("test:3:broken:11 "));
  EXPECT_TRUE(some[4].starts_with("test:3:closed-generic:19 "));
}

TEST_F(Trials, GoOnWhereARunEnded) {
  auto request = request_of(8);
  Store store = open("store");
  const auto none = run_trials(request, store, std::chrono::steady_clock::now(), {});
  EXPECT_FALSE(none.complete);
  EXPECT_EQ(none.trials, 0u);
  std::uint64_t calls = 0;
  TrialProgress last;
  const auto whole = run_trials(request, store, in_ten_minutes(), [&](const TrialProgress& p) {
    ++calls;
    EXPECT_GT(p.done_trials, last.done_trials);
    last = p;
  });
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(whole.trials, 12u);
  EXPECT_EQ(calls, 12u);
  EXPECT_EQ(last.done_trials, last.quota);
  EXPECT_EQ(last.defects, 0u);
  const auto again = run_trials(request, store, in_ten_minutes(), {});
  EXPECT_TRUE(again.complete);
  EXPECT_EQ(again.trials, 0u);
}

TEST_F(Trials, AreMadeAgainByTheirId) {
  const auto request = request_of(6);
  std::uint64_t compared = 0;
  run(request).for_each_trial([&](const TrialRecord& r) {
    EXPECT_EQ(r.id, trial_id(request.plan, request.seed, r.family, r.index));
    const auto& family = *find_family(r.family);
    const auto made = make_case(family, r.id);
    EXPECT_EQ(corpus::case_text(made.c), corpus::case_text(make_case(family, r.id).c));
    EXPECT_EQ(static_cast<std::uint64_t>(made.c.triangles.rows()), r.triangles);
    std::uint64_t pairs = 0;
    const auto truth = judge_case(made.c);
    for (const auto& step : truth) pairs += step.pairs.size();
    EXPECT_EQ(pairs, r.pairs);
    EXPECT_EQ(extremes_of(made.c, truth), r.counts.extremes);
    for (const auto& tag : made.tags) EXPECT_EQ(r.counts.tags.at(tag), 1u);
    ++compared;
  });
  EXPECT_EQ(compared, 9u);
  EXPECT_EQ(trial_id(request.plan, 7, "broken", 12), "test:7:broken:12");
}

TEST_F(Trials, TellWhetherPairsWereLeftOut) {
  auto request = request_of(6);
  request.plan.laws_every = 0;
  request.plan.strata = {{"closed-generic", 6, 0}, {"counted", 6, 0}};
  const auto counts = test::tally_in(run(request, "built-in")).counts;
  EXPECT_EQ(counts.measures.relation_trials, 6u);
  EXPECT_GE(counts.extremes.bodies, 2u);
  EXPECT_GE(counts.extremes.pairs, 1u);
  // A detector that is told no relation is tried by none.
  test::set_plugin(request, test::plugin("always_free"));
  const auto without = test::tally_in(run(request, "plug-in")).counts;
  EXPECT_EQ(without.measures.relation_trials, 0u);
  EXPECT_EQ(without.extremes.bodies, 0u);
  EXPECT_GT(without.extremes.triangles, 0u);
}

TEST_F(Trials, WithoutAWorkerNothingIsJudged) {
  auto request = request_of(4, 2);
  request.worker = "/nowhere/assay-worker";
  Store store = open("store");
  const auto end = run_trials(request, store, in_ten_minutes(), {});
  EXPECT_FALSE(end.complete);
  EXPECT_EQ(end.trials, 0u);
  EXPECT_EQ(end.harness_problem, "");
  ASSERT_TRUE(end.problem);
  EXPECT_TRUE(says(*end.problem, "cannot start /nowhere/assay-worker"));
  EXPECT_EQ(store.trial_count(), 0u);
}

// The record of a trial, and the case of its failure, also say whether the start was vouched for.
TEST_F(Trials, AFaultIsFoundKeptThriceAndReplays) {
  const auto request = faulty("pair/zero-zero-dropped", 150);
  const Store store = run(request);
  const Tally tally = test::tally_in(store);
  std::map<std::string, bool> vouched;
  store.for_each_trial([&](const TrialRecord& r) {
    const auto c = make_case(*find_family(r.family), r.id).c;
    vouched[r.id] = is_vouched_for(request.detector, c, r.index);
    EXPECT_EQ(r.counts.tags.count("start:clean"), vouched.at(r.id) ? 1u : 0u) << r.id;
    EXPECT_EQ(r.counts.tags.count("start:verified"), vouched.at(r.id) ? 0u : 1u) << r.id;
  });
  std::uint64_t defects = 0;
  for (const auto& [family, stratum] : tally.strata) {
    defects += stratum.by_configuration[0].defects;
    EXPECT_EQ(stratum.by_configuration[1].holds, stratum.trials);
  }
  EXPECT_GT(defects, 3u);
  const auto met = store.signatures();
  Counts kept;
  std::uint64_t of_claims = 0, of_laws = 0;
  std::map<bool, int> failures;  // by whether their start was vouched for
  for (const auto& failure : store.failures()) {
    ++kept[failure.signature()];
    EXPECT_FALSE(failure.flaky);
    const auto c = corpus::parse_case(failure.mesh, failure.id());
    ASSERT_TRUE(c) << c.error().message;
    EXPECT_TRUE(says(c.value().source, failure.id()));
    const bool is_clean = vouched.at(failure.id());
    EXPECT_EQ(c.value().options.at("start"), is_clean ? "clean" : "verified") << failure.id();
    ++failures[is_clean];
    const auto& configuration = request.detector.configurations[0];
    if (failure.signature().starts_with("law ")) {
      ++of_laws;
      EXPECT_EQ(c.value().id, failure.id());
      const Law* law = law_named(failure.signature().substr(4));
      ASSERT_TRUE(law);
      const auto finding = judge_of_law(*law, configuration)(c.value());
      ASSERT_TRUE(finding) << failure.id() << failure.signature();
      EXPECT_EQ(finding->signature, failure.signature());
      EXPECT_TRUE(says(c.value().about, law->name));
      continue;
    }
    ++of_claims;
    EXPECT_EQ(c.value().id.find(':'), std::string::npos);
    EXPECT_EQ(failure.configuration, "faulty");
    EXPECT_TRUE(says(c.value().about, failure.signature()));
    WorkerProcess worker(ASSAY_WORKER, std::nullopt);
    const auto finding = judge_of_detector(request.detector, configuration, worker)(c.value());
    ASSERT_TRUE(finding) << failure.id();
    EXPECT_EQ(finding->signature, failure.signature());
  }
  EXPECT_GT(of_claims, 0u);
  EXPECT_GT(of_laws, 0u);
  EXPECT_GT(std::min(failures[true], failures[false]), 0);
  EXPECT_GT(broken_laws(tally.counts), 0u);
  for (const auto& [signature, count] : met)
    EXPECT_EQ(kept[signature], std::min<std::uint64_t>(count, 3)) << signature;
}

TEST_F(Trials, FailuresShrinkAndGoOnShrinking) {
  const auto request = faulty("pair/zero-zero-dropped", 60);
  Store store = run(request);
  ASSERT_FALSE(store.failures().empty());
  constexpr std::uint64_t few = 20, many = 100;
  constexpr double seconds = 1000;  // beyond the deadline: more than a failure will have had
  shrink_failures(request, store, {seconds, few}, in_ten_minutes(), {});
  const auto size_of = [](const std::string& mesh) {
    return corpus::parse_case(mesh, "mesh").value().triangles.rows();
  };
  std::set<std::string> signatures;
  std::map<std::string, Eigen::Index> triangles;
  for (const auto& failure : store.failures()) {
    signatures.insert(failure.signature());
    if (failure.smallest.empty()) continue;
    const auto small = size_of(failure.smallest);
    EXPECT_TRUE(triangles.emplace(failure.signature(), small).second) << "shrunk twice";
    EXPECT_LE(small, size_of(failure.mesh)) << failure.signature();
  }
  EXPECT_EQ(triangles.size(), signatures.size());  // one each, of laws as of claims
  // Each had few calls only: the same again goes on from there, and never gets larger.
  shrink_failures(request, store, {seconds, many}, in_ten_minutes(), {});
  bool smaller = false;
  for (const auto& failure : store.failures()) {
    if (failure.smallest.empty()) continue;
    const auto small = size_of(failure.smallest), before = triangles.at(failure.signature());
    EXPECT_LE(small, before);
    smaller |= small < before;
  }
  EXPECT_TRUE(smaller);
}

// The built-in detector under campaign smoke comes to the same, trial by trial, judged as the
// built-in one and as a plug-in whose description names nothing of the contract: ABI 2 loosens
// nothing, and takes nothing away. So does a planted fault.

using TrialSums = std::tuple<std::string, std::string, std::uint64_t, std::uint64_t, std::uint64_t,
                             std::uint64_t, std::uint64_t>;

class JudgedAlike : public testing::Test {
 protected:
  // The cases of smoke under its seed, every `one_of`th part of each family.
  static CampaignRequest smoke(std::uint64_t one_of) {
    CampaignRequest request = request_of(0, 2);
    request.seed = default_seed;
    // The plug-ins take no relation, and of limits and distances the built-in is asked apart.
    request.plan = without_questions(without_relations(find_plan("smoke").value()));
    EXPECT_EQ(request.plan.name, "smoke");
    for (auto& stratum : request.plan.strata) stratum.cases /= one_of;
    request.plan.laws_every = 0;
    return request;
  }
  static CampaignRequest as_built_in(CampaignRequest request, const Configuration& configuration) {
    request.detector.configurations = {configuration};
    return request;
  }
  static CampaignRequest as_plugin(CampaignRequest request, const std::string& name) {
    test::set_plugin(request, test::plugin(name));
    EXPECT_EQ(request.detector.contract, (Contract{.takes_relations = false, .progress = 0.9}))
        << "the defaults leave nothing out but what takes a function";
    EXPECT_EQ(list_of(request.detector.claims.without(claims_on_limits)), list_of(claims_of({})));
    request.detector.configurations = {{"plug-in", {}}};
    return request;
  }

  // What the trials come to, one by one; notes how many have a defect.
  std::vector<TrialSums> trials_of(const CampaignRequest& request, std::uint64_t& with_defect) {
    const auto store = test::with_all_trials(request, scratch / std::to_string(stores++));
    std::vector<TrialSums> trials;
    store.for_each_trial([&](const TrialRecord& r) {
      trials.emplace_back(r.id, r.outcomes, r.triangles, r.steps, r.collisions, r.pairs, r.mesh);
    });
    const auto tally = test::tally_in(store);
    EXPECT_EQ(tally.trials(), planned_trial_count(request.plan, 1));
    EXPECT_EQ(tally.judged_trials(), tally.trials());
    EXPECT_EQ(tally.open(), 0u);
    with_defect = tally.with_defect();
    return trials;
  }

  // Trials with a defect, in both alike.
  std::uint64_t expect_alike(const CampaignRequest& built_in, const CampaignRequest& plugin) {
    std::uint64_t defects = 0;
    const auto of_built_in = trials_of(built_in, defects), of_plugin = trials_of(plugin, defects);
    EXPECT_EQ(of_built_in.size(), of_plugin.size());
    for (std::size_t i = 0; i < std::min(of_built_in.size(), of_plugin.size()); ++i)
      EXPECT_EQ(of_built_in[i], of_plugin[i]) << std::get<0>(of_built_in[i]);
    return defects;
  }
  const tests::Scratch scratch;
  int stores = 0;
};

TEST_F(JudgedAlike, TheBuiltInDetectorHolds) {
  const auto request = smoke(1);
  EXPECT_EQ(planned_trial_count(request.plan, 1), 2800u);
  EXPECT_EQ(
      expect_alike(as_built_in(request, {"view-auto", {}}), as_plugin(request, "wrapped_builtin")),
      0u);
}

TEST_F(JudgedAlike, APlantedFaultShowsInTheSameTrials) {
  for (const std::string name : {"elementary/only-vertex-face", "elementary/end-excluded"}) {
    SCOPED_TRACE(name);
    auto file = name;
    std::replace(file.begin(), file.end(), '/', '_');
    const auto request = smoke(10);
    const Configuration faulty{"faulty", find_fault(name)->options, name};
    EXPECT_GT(expect_alike(as_built_in(request, faulty), as_plugin(request, "fault_" + file)), 0u);
  }
}

}  // namespace
}  // namespace assay::properties
