// The trials of a campaign: the same for any jobs, resumed, made again by their id;
// their failures are kept, replayed and shrunk.
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
  Store open(const std::string& name) const {
    auto store = Store::open(scratch / name, "b");
    EXPECT_TRUE(store) << store.error().message;
    return std::move(store.value());
  }
  // Each trial in a line, without its times.
  static std::vector<std::string> lines(const Store& store) {
    std::vector<std::string> list;
    store.for_each_trial([&](const TrialRecord& r) {
      std::ostringstream line;
      line << r.id << ' ' << r.family << ' ' << r.index << ' ' << lasting(to_row(r)).fields;
      list.push_back(line.str());
    });
    return list;
  }
  std::vector<std::string> run(const std::string& name, const CampaignRequest& request) const {
    Store store = open(name);
    const auto end = run_trials(request, store, in_ten_minutes(), {});
    EXPECT_TRUE(end.complete);
    EXPECT_EQ(end.harness_problem, "");
    return lines(store);
  }
  Scratch scratch;
};

TEST_F(Trials, DoNotDependOnJobs) {
  const auto alone = run("one", request_of(20));
  ASSERT_EQ(alone.size(), 30u);
  EXPECT_NE(alone[0].find("test:3:broken:0"), std::string::npos);
  EXPECT_EQ(run("three", request_of(20, 3)), alone);
}

// Those of seed 3: of eight shares the places 3, 11, ... of each family.
TEST_F(Trials, OfAShareAreThoseOfItsSeed) {
  const auto some = run("share", request_of(20, 2, 8));
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
  Store store = open("store");
  run_trials(request, store, in_ten_minutes(), {});
  std::uint64_t compared = 0;
  store.for_each_trial([&](const TrialRecord& r) {
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

// The largest of each is that of some case, whichever it is.
TEST_F(Trials, TellHowFarTheyWentAndWhetherPairsWereLeftOut) {
  auto request = request_of(6);
  request.plan.laws_every = 0;
  request.plan.strata = {{"closed-generic", 6, 0}, {"counted", 6, 0}};
  const auto tallied = [&](const std::string& name) {
    Store store = open(name);
    EXPECT_TRUE(run_trials(request, store, in_ten_minutes(), {}).complete);
    Tally tally;
    store.for_each_trial([&](const TrialRecord& r) { tally.add(r); });
    EXPECT_EQ(tally.trials(), 12u);
    return tally.counts;
  };
  const auto counts = tallied("built-in");
  Extremes most;
  std::uint64_t relations = 0;
  for (const auto* family : {"closed-generic", "counted"}) {
    for (std::uint64_t i = 0; i < 6; ++i) {
      const auto id = trial_id(request.plan, request.seed, family, i);
      const auto c = make_case(*find_family(family), id).c;
      most.include(extremes_of(c, judge_case(c)));
      relations += c.counted ? 1 : 0;
    }
  }
  EXPECT_EQ(counts.extremes, most);
  EXPECT_EQ(counts.measures.relation_trials, relations);
  EXPECT_EQ(relations, 6u);
  EXPECT_GE(most.bodies, 2u);
  EXPECT_GE(most.pairs, 1u);
  // A detector that is told no relation is tried by none.
  test::set_plugin(request, test::plugin("always_free"));
  const auto without = tallied("plug-in");
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

TEST_F(Trials, AFaultIsFoundKeptThriceAndReplays) {
  const auto request = faulty("pair/zero-zero-dropped", 150);
  Store store = open("store");
  const auto end = run_trials(request, store, in_ten_minutes(), {});
  ASSERT_TRUE(end.complete);
  Tally tally;
  store.for_each_trial([&](const TrialRecord& r) { tally.add(r); });
  std::uint64_t defects = 0;
  for (const auto& [family, stratum] : tally.strata) {
    defects += stratum.by_configuration[0].defects;
    EXPECT_EQ(stratum.by_configuration[1].holds, stratum.trials);
  }
  EXPECT_GT(defects, 3u);
  const auto met = store.signatures();
  Counts kept;
  std::uint64_t of_claims = 0, of_laws = 0;
  for (const auto& failure : store.failures()) {
    ++kept[failure.signature()];
    EXPECT_FALSE(failure.flaky);
    const auto c = corpus::parse_case(failure.mesh, failure.id());
    ASSERT_TRUE(c) << c.error().message;
    EXPECT_NE(c.value().source.find(failure.id()), std::string::npos);
    EXPECT_FALSE(c.value().options.empty());
    const auto& configuration = request.detector.configurations[0];
    if (failure.signature().starts_with("law ")) {
      ++of_laws;
      EXPECT_EQ(c.value().id, failure.id());
      const Law* law = law_named(failure.signature().substr(4));
      ASSERT_TRUE(law);
      const auto finding = judge_of_law(*law, configuration)(c.value());
      ASSERT_TRUE(finding) << failure.id() << failure.signature();
      EXPECT_EQ(finding->signature, failure.signature());
      EXPECT_NE(c.value().about.find(law->name), std::string::npos);
      continue;
    }
    ++of_claims;
    EXPECT_EQ(c.value().id.find(':'), std::string::npos);
    EXPECT_EQ(failure.configuration, "faulty");
    EXPECT_NE(c.value().about.find(failure.signature()), std::string::npos);
    WorkerProcess worker(ASSAY_WORKER, std::nullopt);
    const auto finding = judge_of_detector(request.detector, configuration, worker)(c.value());
    ASSERT_TRUE(finding) << failure.id();
    EXPECT_EQ(finding->signature, failure.signature());
  }
  EXPECT_GT(of_claims, 0u);
  EXPECT_GT(of_laws, 0u);
  EXPECT_GT(broken_laws(tally.counts), 0u);
  for (const auto& [signature, count] : met) {
    EXPECT_EQ(kept[signature], std::min<std::uint64_t>(count, 3)) << signature;
  }
}

TEST_F(Trials, FailuresShrinkAndGoOnShrinking) {
  const auto request = faulty("pair/zero-zero-dropped", 60);
  Store store = open("store");
  run_trials(request, store, in_ten_minutes(), {});
  ASSERT_FALSE(store.failures().empty());
  constexpr std::uint64_t few = 20, many = 100;
  constexpr double seconds = 1000;  // beyond the deadline: more than a failure will have had
  shrink_failures(request, store, {seconds, few}, in_ten_minutes(), {});
  std::set<std::string> signatures, shrunk;
  std::map<std::string, std::size_t> triangles;
  for (const auto& failure : store.failures()) {
    signatures.insert(failure.signature());
    if (failure.smallest.empty()) continue;
    EXPECT_TRUE(shrunk.insert(failure.signature()).second)
        << "shrunk twice: " << failure.signature();
    const auto whole = corpus::parse_case(failure.mesh, "mesh").value();
    const auto small = corpus::parse_case(failure.smallest, "smallest").value();
    EXPECT_LE(small.triangles.rows(), whole.triangles.rows());
    triangles[failure.signature()] = static_cast<std::size_t>(small.triangles.rows());
  }
  EXPECT_EQ(shrunk, signatures);  // one each, of laws as of claims
  // Each had few calls only: the same again goes on from there, and never gets larger.
  shrink_failures(request, store, {seconds, many}, in_ten_minutes(), {});
  bool smaller = false;
  for (const auto& failure : store.failures()) {
    if (failure.smallest.empty()) continue;
    const auto small = corpus::parse_case(failure.smallest, "smallest").value();
    const auto before = triangles.at(failure.signature());
    EXPECT_LE(static_cast<std::size_t>(small.triangles.rows()), before);
    smaller |= static_cast<std::size_t>(small.triangles.rows()) < before;
  }
  EXPECT_TRUE(smaller);
}

// Who leaves neighbours out would not recognise a miss of strangers that had become one of
// neighbours, nor one far into the step that had moved to its start.
TEST_F(Trials, AFailureOfAPlugInKeepsWhatItsPairSharesAndWhen) {
  auto request = request_of(60, 2);
  request.plan.laws_every = 0;
  test::set_plugin(request, test::plugin("always_free"));
  auto worker = request.process();
  Store store = open("store");
  ASSERT_TRUE(run_trials(request, store, in_ten_minutes(), {}).complete);
  constexpr double hour = 3600;
  constexpr std::uint64_t calls = 300;
  shrink_failures(request, store, {hour, calls}, in_ten_minutes(), {});
  const auto judge =
      judge_of_detector(request.detector, request.detector.configurations[0], worker);
  using Shown = std::pair<int, bool>;  // vertices shared, in the first thousandth of the step
  const auto sign_of = [&](const std::string& text) {
    const auto c = corpus::parse_case(text, "failure").value();
    const auto finding = judge(c);
    EXPECT_TRUE(finding && finding->focus.size() == 2);
    if (!finding || finding->focus.size() != 2) return Shown{-1, false};
    const detector::TrianglePair pair{finding->focus[0], finding->focus[1]};
    const auto truth = judge_case(c, Contract{})[finding->step];
    const auto contact = std::find_if(truth.pairs.begin(), truth.pairs.end(),
                                      [&](const auto& met) { return met.pair == pair; });
    return Shown{shared_vertices(c.triangles, pair), contact->time.hi <= 0x1p-10};
  };
  std::array<int, 3> kinds{};
  for (const auto& failure : store.failures()) {
    if (failure.smallest.empty()) continue;
    const Shown whole = sign_of(failure.mesh);
    EXPECT_EQ(sign_of(failure.smallest), whole) << failure.signature();
    ++kinds[static_cast<std::size_t>(std::clamp(whole.first, 0, 2))];
  }
  for (const int kind : kinds) EXPECT_GT(kind, 0) << kinds[0] << ' ' << kinds[1] << ' ' << kinds[2];
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
    CampaignRequest request;
    // The plug-ins take no relation, and of limits and distances the built-in is asked apart.
    request.plan = without_questions(without_relations(find_plan("smoke").value()));
    EXPECT_EQ(request.plan.name, "smoke");
    for (auto& stratum : request.plan.strata) stratum.cases /= one_of;
    request.plan.laws_every = 0;
    request.jobs = 2;
    request.worker = ASSAY_WORKER;
    return request;
  }
  static CampaignRequest as_built_in(CampaignRequest request, const Configuration& configuration) {
    request.detector = built_in_detector();
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

  Tally tally_of(const std::string& name, const CampaignRequest& request,
                 std::vector<TrialSums>& trials) const {
    auto file = name;
    std::replace(file.begin(), file.end(), '/', '-');
    auto store = Store::open(scratch / file, "b").value();
    const auto end =
        run_trials(request, store, std::chrono::steady_clock::now() + std::chrono::hours(1), {});
    EXPECT_TRUE(end.complete) << end.harness_problem;
    Tally tally;
    store.for_each_trial([&](const TrialRecord& r) {
      tally.add(r);
      trials.emplace_back(r.id, r.outcomes, r.triangles, r.steps, r.collisions, r.pairs, r.mesh);
    });
    EXPECT_EQ(tally.trials(), planned_trial_count(request.plan, 1));
    return tally;
  }

  // Trials with a defect, in both alike.
  std::uint64_t expect_alike(const CampaignRequest& built_in, const CampaignRequest& plugin) const {
    std::vector<TrialSums> of_built_in, of_plugin;
    const auto one =
        tally_of("built-in " + built_in.detector.configurations[0].fault, built_in, of_built_in);
    const auto other = tally_of(plugin.detector.name, plugin, of_plugin);
    EXPECT_EQ(of_built_in.size(), of_plugin.size());
    for (std::size_t i = 0; i < std::min(of_built_in.size(), of_plugin.size()); ++i)
      EXPECT_EQ(of_built_in[i], of_plugin[i]) << std::get<0>(of_built_in[i]);
    for (const auto& [family, stratum] : one.strata) {
      const auto& alike = other.strata.at(family);
      EXPECT_EQ(stratum.trials, alike.trials) << family;
      EXPECT_EQ(stratum.steps, alike.steps) << family;
      EXPECT_EQ(stratum.collisions, alike.collisions) << family;
      EXPECT_EQ(stratum.pairs, alike.pairs) << family;
      EXPECT_EQ(stratum.meshes, alike.meshes) << family;
      EXPECT_EQ(stratum.sizes, alike.sizes) << family;
      EXPECT_EQ(stratum.contacts, alike.contacts) << family;
      EXPECT_EQ(stratum.discards + alike.discards, 0u) << family;
      EXPECT_EQ(stratum.by_configuration, alike.by_configuration) << family;
    }
    EXPECT_EQ(one.open() + other.open(), 0u);
    return one.with_defect();
  }
  const tests::Scratch scratch;
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
