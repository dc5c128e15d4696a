// A campaign's parts: plans, records, the store, trials and their verdicts.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "corpus/json_text.h"
#include "properties/campaign/binding.h"
#include "properties/campaign/campaign_facts.h"
#include "properties/campaign/case_tally.h"
#include "properties/campaign/runner.h"
#include "properties/campaign/shrink.h"
#include "properties/case_check.h"
#include "properties/generators/families.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using detector::Answer;
using detector::Culling;
using detector::Pairs;
using detector::Start;
using nlohmann::ordered_json;
using tests::Scratch;

// --- plans

const char* const whole_plan = R"({"schema": "assay-campaign/1", "name": "tiny-1.a",
  "strata": [{"family": "closed-generic", "cases": 12, "bound": 0.5},
             {"family": "broken", "cases": 5}],
  "seconds": 30, "case_seconds": 2.5, "laws_every": 3, "law_premises": 4, "fault_cases": 7,
  "fault_seeds": 2, "shrink_faults": true, "tetrahedron_seconds": 1.5, "shrink_share": 0.25,
  "policy": {"power": 0.5, "self_test_queries": 9, "speed_limits": {"exact-over-double": 1.5}}})";

class Plans : public testing::Test {
 protected:
  corpus::Expected<CampaignPlan> read(const std::string& text) const {
    return find_plan(scratch.write("plan.json", text));
  }
  // The plan with one field changed (null: taken away) is refused, in one line that names the file
  // and says why.
  void expect_wrong(const char* pointer, const ordered_json& value, const std::string& why) const {
    auto json = ordered_json::parse(whole_plan);
    json[ordered_json::json_pointer(pointer)] = value;
    SCOPED_TRACE(pointer + value.dump());
    expect_refused(json.dump(), why);
  }
  void expect_refused(const std::string& text, const std::string& why) const {
    const auto plan = read(text);
    ASSERT_FALSE(plan);
    const auto& message = plan.error().message;
    EXPECT_NE(message.find("plan.json"), std::string::npos) << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  Scratch scratch;
};

TEST_F(Plans, AFileSaysAllOfIt) {
  const auto read_plan = read(whole_plan);
  ASSERT_TRUE(read_plan) << read_plan.error().message;
  const auto& plan = read_plan.value();
  EXPECT_EQ(plan.name, "tiny-1.a");
  ASSERT_EQ(plan.strata.size(), 2u);
  EXPECT_EQ(plan.strata[0].family, "closed-generic");
  EXPECT_EQ(plan.strata[0].cases, 12u);
  EXPECT_EQ(plan.strata[0].wanted_bound, .5);
  EXPECT_EQ(plan.strata[1].wanted_bound, 0);
  EXPECT_EQ(plan.seconds, 30);
  EXPECT_EQ(plan.case_seconds, 2.5);
  EXPECT_EQ(plan.laws_every, 3u);
  EXPECT_EQ(plan.law_premises, 4u);
  EXPECT_EQ(plan.fault_cases, 7u);
  EXPECT_EQ(plan.fault_seeds, 2);
  EXPECT_TRUE(plan.shrink_faults);
  EXPECT_EQ(plan.tetrahedron_seconds, 1.5);
  EXPECT_EQ(plan.shrink_share, .25);
  EXPECT_EQ(plan.policy.power, .5);
  EXPECT_EQ(plan.policy.self_test_queries, 9u);
  ASSERT_EQ(plan.policy.speed_limits.size(), 1u);
  EXPECT_EQ(plan.policy.speed_limits[0].what, "exact-over-double");
  EXPECT_EQ(plan.policy.speed_limits[0].limit, 1.5);
}

TEST_F(Plans, SurviveTheirText) {
  auto plans = named_plans();
  plans.push_back(read(whole_plan).value());
  std::set<std::string> texts;
  for (const auto& plan : plans) {
    const std::string text = plan_text(plan);
    const auto again = read(text);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(plan_text(again.value()), text);
    EXPECT_EQ(again.value().strata.size(), plan.strata.size());
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), plans.size());
}

TEST_F(Plans, EveryFieldIsPartOfTheText) {
  const auto known = ordered_json::parse(plan_text(read(whole_plan).value()));
  const auto stated = ordered_json::parse(whole_plan);
  for (const auto& [key, value] : stated.items()) {
    EXPECT_TRUE(known.contains(key)) << key;
    if (key != "strata") {
      EXPECT_EQ(known[key], value) << key;
    }
  }
}

TEST_F(Plans, AWrongFieldIsOneClearLine) {
  expect_wrong("/schema", "assay-campaign/2", "assay-campaign/1 expected");
  expect_wrong("/name", "", "name");
  expect_wrong("/name", "a:b", "name");
  expect_wrong("/name", "../up", "name");
  expect_wrong("/name", "two words", "name");
  expect_wrong("/name", 7, "name: a text expected");
  expect_wrong("/strata", 7, "strata: an array expected");
  expect_wrong("/strata/0", 7, "strata[0]");
  expect_wrong("/strata/0/family", "closed", "strata[0].family: no family of this name");
  expect_wrong("/strata/1/family", "closed-generic", "strata[1].family: this family is there");
  expect_wrong("/strata/0/cases", -1, "strata[0].cases");
  expect_wrong("/strata/0/cases", 1.5, "strata[0].cases: a whole number expected");
  expect_wrong("/strata/0/cases", 1'000'000'001, "strata[0].cases");
  expect_wrong("/strata/0/bound", 1, "strata[0].bound: 0 <= bound < 1");
  expect_wrong("/strata/0/bound", -.1, "strata[0].bound");
  expect_wrong("/strata/0/bounds", .1, "strata[0]: no field 'bounds'");
  expect_wrong("/seconds", 0, "seconds above 0");
  expect_wrong("/seconds", -1, "seconds: a number of at least 0");
  expect_wrong("/seconds", "ten", "seconds: a number expected");
  expect_wrong("/second", 10, "no field 'second'");
  expect_wrong("/case_seconds", 0, "case_seconds above 0");
  expect_wrong("/shrink_share", 1.5, "shrink_share");
  expect_wrong("/shrink_faults", 1, "shrink_faults: true or false");
  expect_wrong("/laws_every", -1, "laws_every");
  expect_wrong("/law_premises", "many", "law_premises");
  expect_wrong("/fault_seeds", 0, "fault_cases and fault_seeds");
  expect_wrong("/fault_cases", 0, "fault_cases and fault_seeds");
  expect_wrong("/tetrahedron_seconds", -1, "tetrahedron_seconds");
  expect_wrong("/policy", 1, "policy: an object expected");
  expect_wrong("/policy/power", 0, "policy.power: 0 < power <= 1");
  expect_wrong("/policy/power", 1.01, "policy.power");
  expect_wrong("/policy/powers", 1, "policy: no field 'powers'");
  expect_wrong("/policy/self_test_queries", -1, "policy.self_test_queries");
  expect_wrong("/policy/speed_limits", 2, "policy.speed_limits: an object expected");
  expect_wrong("/policy/speed_limits/slow", 2, "policy.speed_limits: no figure 'slow'");
  expect_wrong("/policy/speed_limits/exact-over-double", 0, "speed_limits.exact-over-double");
  expect_refused("{\"schema\": ", "plan.json");
  expect_refused("[]", "an object expected");
  expect_refused("", "empty");
  for (const char* key : {"schema", "name", "strata"}) {
    auto json = ordered_json::parse(whole_plan);
    json.erase(key);
    expect_refused(json.dump(), std::string(key) + " is missing");
  }
  auto without = ordered_json::parse(whole_plan);
  without.erase("seconds");
  expect_refused(without.dump(), "seconds above 0");
  expect_refused(
      R"({"schema": "assay-campaign/1", "name": "a", "strata": [{"family": "broken", "cases": 0}],
          "seconds": 1})",
      "nothing to do");
}

TEST_F(Plans, NamedOnesListKnownFamiliesOnce) {
  std::set<std::string> names;
  for (const auto& plan : named_plans()) {
    names.insert(plan.name);
    std::set<std::string> families_of_plan;
    for (const auto& stratum : plan.strata) {
      const auto known = families();
      EXPECT_TRUE(std::any_of(known.begin(), known.end(), [&](const Family& f) {
        return f.name == stratum.family;
      })) << stratum.family;
      families_of_plan.insert(stratum.family);
    }
    EXPECT_EQ(families_of_plan.size(), plan.strata.size());
    EXPECT_LE(plan.strata.size(), 24u);
    EXPECT_GT(plan.seconds, 0);
    EXPECT_FALSE(plan.about.empty());
    EXPECT_EQ(find_plan(plan.name).value().seconds, plan.seconds);
  }
  EXPECT_EQ(names, (std::set<std::string>{"smoke", "quick", "nightly", "release", "faults"}));
  const auto missing = find_plan("no-such-campaign");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("no-such-campaign"), std::string::npos);
}

// --- records

TEST(Counts, SurviveTheirText) {
  const Counts counts = {
      {"law:L3_First/premise", 7}, {"tag:a=b", 1}, {"block:V+ V-", 18446744073709551615u}};
  EXPECT_EQ(parse_counts(counts_text(counts)), counts);
  EXPECT_EQ(counts_text({}), "");
  EXPECT_TRUE(parse_counts("").empty());
  EXPECT_EQ(counts_text({{"b", 2}, {"a", 1}}), "a=1;b=2");
  EXPECT_EQ(parse_counts("a=1;a=2"), (Counts{{"a", 3}}));
  Counts sum = {{"a", 1}, {"b", 2}};
  add(sum, {{"b", 3}, {"c", 4}});
  EXPECT_EQ(sum, (Counts{{"a", 1}, {"b", 5}, {"c", 4}}));
}

TEST(Counts, TallyOfAStratum) {
  Tally tally;
  tally.add({"p:1:broken:0", "broken", 0, "HDUE", 5, 2, 1, 3, 10, 20, {{"tag:x", 1}}});
  tally.add({"p:1:broken:1", "broken", 1, "HHDH", 4, 1, 0, 0, 1, 2, {{"tag:x", 1}}});
  // A case that the detector's numbers do not hold is a trial of no configuration.
  tally.add({"p:1:broken:2", "broken", 2, "", 0, 0, 0, 0, 0, 0, {}});
  tally.add({"p:1:closed-generic:0", "closed-generic", 0, "H", 200, 1, 1, 1, 0, 0, {}});
  EXPECT_EQ(tally.counts, (Counts{{"tag:x", 2}}));
  ASSERT_EQ(tally.strata.size(), 2u);
  const auto& broken = tally.strata.at("broken");
  EXPECT_EQ(broken.trials, 3u);
  EXPECT_EQ(broken.steps, 3u);
  EXPECT_EQ(broken.collisions, 1u);
  EXPECT_EQ(broken.pairs, 3u);
  EXPECT_EQ(broken.oracle_us, 11u);
  EXPECT_EQ(broken.detector_us, 22u);
  ASSERT_EQ(broken.by_configuration.size(), 4u);
  EXPECT_EQ(broken.by_configuration[0].holds, 2u);
  EXPECT_EQ(broken.by_configuration[1].defects, 1u);
  EXPECT_EQ(broken.by_configuration[2].undecided, 1u);
  EXPECT_EQ(broken.by_configuration[2].defects, 1u);
  EXPECT_EQ(broken.by_configuration[3].errors, 1u);
  EXPECT_EQ(broken.sizes, (std::map<int, std::uint64_t>{{-1, 1}, {2, 2}}));
  EXPECT_EQ(broken.contacts, (std::map<int, std::uint64_t>{{-1, 2}, {1, 1}}));
  EXPECT_EQ(tally.strata.at("closed-generic").sizes, (std::map<int, std::uint64_t>{{7, 1}}));
}

TEST(Counts, LettersOfOutcomes) {
  EXPECT_EQ(letter_of(Outcome::holds), 'H');
  EXPECT_EQ(letter_of(Outcome::defect), 'D');
  EXPECT_EQ(letter_of(Outcome::undecided), 'U');
  EXPECT_EQ(letter_of(Outcome::error), 'E');
}

// --- shards

TEST(Shards, PartitionTheTrials) {
  CampaignPlan plan;
  plan.strata = {{"broken", 25, 0}, {"closed-generic", 2, 0}, {"closed-degenerate", 0, 0}};
  for (const std::uint64_t count : {1u, 2u, 3u, 7u, 40u}) {
    std::uint64_t planned = 0;
    std::vector<int> holders(25);
    for (std::uint64_t i = 1; i <= count; ++i) {
      const Shard shard{i, count};
      planned += planned_trial_count(plan, shard);
      for (std::uint64_t place = 0; place < 25; ++place) holders[place] += shard.holds(place);
    }
    EXPECT_EQ(planned, 27u) << count;
    EXPECT_EQ(holders, std::vector<int>(25, 1)) << count;
  }
  EXPECT_EQ(planned_trial_count(plan, {1, 1}), 27u);
  EXPECT_EQ(planned_trial_count(plan, {3, 3}), 8u);
}

// --- the store

class Stores : public testing::Test {
 protected:
  Scratch scratch;
  std::string file = scratch / "trials.sqlite";
  Store open(const std::string& binding = "one") const {
    std::string problem;
    auto store = Store::open(file, binding, problem);
    EXPECT_TRUE(store) << problem;
    return std::move(*store);
  }
  static std::string problem_of_open(const std::string& path, const std::string& binding) {
    std::string problem;
    EXPECT_FALSE(Store::open(path, binding, problem));
    EXPECT_NE(problem.find(path), std::string::npos) << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
    return problem;
  }
  static std::string problem_of_read(const std::string& path) {
    std::string problem;
    EXPECT_FALSE(Store::read(path, problem));
    EXPECT_NE(problem.find(path), std::string::npos) << problem;
    return problem;
  }
  static StoredFailure failure(const std::string& id, const std::string& signature) {
    return {id, "view-point", signature, "what", "mesh of " + id, "", false};
  }
  static TrialRecord record(std::uint64_t i) {
    return {
        "p:1:broken:" + std::to_string(i), "broken", i, "HD", 1, 2, 3, 4, 5, 6, {{"tag:x", i}}, ~i};
  }
};

TEST_F(Stores, KeepWhatIsAdded) {
  {
    Store store = open();
    for (const std::uint64_t i : {10u, 2u, 0u}) store.add(record(i));
    store.add(failure("b", "s"));
    auto shown = failure("a", "s");
    shown.flaky = true;
    store.add(shown);
    shown.smallest = "small";
    store.set_smallest(shown);
    store.add(record(7), {}, {{"one", "s"}, {"two", "s"}, {"three", "t"}});
    store.set_note("key", "old");
    store.set_note("key", "new");
  }
  const Store store = open();
  std::vector<std::uint64_t> places;
  store.for_each_trial([&](const TrialRecord& r) {
    places.push_back(r.index);
    const auto expected = record(r.index);
    EXPECT_EQ(r.id, expected.id);
    EXPECT_EQ(r.family, "broken");
    EXPECT_EQ(r.outcomes, "HD");
    EXPECT_EQ(r.triangles, 1u);
    EXPECT_EQ(r.steps, 2u);
    EXPECT_EQ(r.collisions, 3u);
    EXPECT_EQ(r.pairs, 4u);
    EXPECT_EQ(r.oracle_us, 5u);
    EXPECT_EQ(r.detector_us, 6u);
    EXPECT_EQ(r.counts, expected.counts);
    EXPECT_EQ(r.mesh, expected.mesh);
  });
  EXPECT_EQ(places, (std::vector<std::uint64_t>{0, 2, 7, 10}));
  EXPECT_EQ(store.trial_count(), 4u);
  EXPECT_TRUE(store.has_trial("p:1:broken:2"));
  EXPECT_FALSE(store.has_trial("p:1:broken:1"));
  const auto failures = store.failures();
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_EQ(failures[0].id, "a");
  EXPECT_EQ(failures[0].smallest, "small");
  EXPECT_TRUE(failures[0].flaky);
  EXPECT_EQ(failures[1].id, "b");
  EXPECT_EQ(failures[1].mesh, "mesh of b");
  EXPECT_TRUE(failures[1].smallest.empty());
  EXPECT_FALSE(failures[1].flaky);
  EXPECT_EQ(store.signatures(), (Counts{{"s", 2}, {"t", 1}}));
  EXPECT_EQ(store.note("key"), "new");
  EXPECT_EQ(store.note("none"), std::nullopt);
  EXPECT_EQ(store.binding(), "one");
}

TEST_F(Stores, TheSameTrialAgainCountsOnce) {
  Store store = open();
  store.add(record(1));
  store.add(record(1));
  store.add(failure("a", "s"));
  store.add(failure("a", "s"));
  EXPECT_EQ(store.trial_count(), 1u);
  EXPECT_EQ(store.failures().size(), 1u);
}

TEST_F(Stores, ATrialIsStoredWithItsFailuresOrNotAtAll) {
  // A process that is killed at once after each of its trials: nothing of them is lost or half
  // there.
  for (std::uint64_t i = 0; i < 5; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      Store store = open();
      store.add(record(i), {failure("f" + std::to_string(i), "s")}, {{"one", "s"}, {"two", "s"}});
      raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const Store store = open();
    EXPECT_EQ(store.trial_count(), i + 1);
    EXPECT_EQ(store.failures().size(), i + 1);
    EXPECT_EQ(store.signatures(), (Counts{{"s", 2 * (i + 1)}}));
  }
}

TEST_F(Stores, OfAnotherRunAreRefused) {
  { open("one"); }
  EXPECT_NE(problem_of_open(file, "two").find("another run"), std::string::npos);
  EXPECT_EQ(open("one").binding(), "one");
}

TEST_F(Stores, AreForOneRunAtATime) {
  const Store store = open();
  EXPECT_NE(problem_of_open(file, "one").find("another run is writing it"), std::string::npos);
  std::string problem;
  EXPECT_TRUE(Store::read(file, problem)) << problem;
}

TEST_F(Stores, ThatAreNoneAreRefused) {
  EXPECT_NE(problem_of_read(file).find("no such file"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
  const auto text = scratch.write("text.sqlite", std::string(5000, 'x'));
  EXPECT_NE(problem_of_open(text, "one").find("not a database"), std::string::npos);
  EXPECT_NE(problem_of_read(text).find("not a database"), std::string::npos);
  EXPECT_EQ(tests::read_text(text), std::string(5000, 'x'));
  // A database of somebody else, and one without anything, are read by nobody and left alone.
  const auto empty = scratch.write("empty.sqlite", "");
  problem_of_read(empty);
  EXPECT_EQ(std::filesystem::file_size(empty), 0u);
  problem_of_open(scratch / "no/such/folder.sqlite", "one");
  std::filesystem::create_directory(scratch / "folder.sqlite");
  problem_of_open(scratch / "folder.sqlite", "one");
}

TEST_F(Stores, DamageIsSeen) {
  {
    Store store = open();
    for (std::uint64_t i = 0; i < 400; ++i) store.add(record(i));
  }
  const std::string whole = tests::read_text(file);
  ASSERT_GT(whole.size(), 20'000u);
  std::string hole = whole;
  std::fill(hole.begin() + 8192, hole.begin() + 16384, '\x5a');
  problem_of_open(scratch.write("hole.sqlite", hole), "one");
  problem_of_open(scratch.write("cut.sqlite", whole.substr(0, whole.size() / 2)), "one");
}

// --- trials

CampaignRequest request_of(std::uint64_t cases, int jobs = 1, Shard shard = {}) {
  CampaignRequest request;
  request.plan.name = "test";
  request.plan.strata = {{"closed-generic", cases, 0}, {"broken", cases / 2, 0}};
  request.plan.seconds = 60;
  request.plan.laws_every = 2;
  request.seed = 3;
  request.jobs = jobs;
  request.shard = shard;
  request.detector = built_in_detector();
  request.worker = ASSAY_WORKER;
  return request;
}

RunDeadline in_a_minute() { return std::chrono::steady_clock::now() + std::chrono::minutes(1); }

class Trials : public testing::Test {
 protected:
  Store open(const std::string& name) const {
    std::string problem;
    auto store = Store::open(scratch / name, "b", problem);
    EXPECT_TRUE(store) << problem;
    return std::move(*store);
  }
  // Each trial in a line, without its times.
  static std::vector<std::string> lines(const Store& store) {
    std::vector<std::string> list;
    store.for_each_trial([&](const TrialRecord& r) {
      std::ostringstream line;
      line << r.id << ' ' << r.family << ' ' << r.index << ' ' << r.outcomes << ' ' << r.triangles
           << ' ' << r.steps << ' ' << r.collisions << ' ' << r.pairs << ' '
           << counts_text(r.counts);
      list.push_back(line.str());
    });
    return list;
  }
  std::vector<std::string> run(const std::string& name, const CampaignRequest& request) const {
    Store store = open(name);
    const auto end = run_trials(request, store, in_a_minute(), {});
    EXPECT_TRUE(end.complete);
    EXPECT_EQ(end.harness_problem, "");
    return lines(store);
  }
  Scratch scratch;
};

TEST_F(Trials, DoNotDependOnJobsOrShards) {
  const auto alone = run("one", request_of(20));
  ASSERT_EQ(alone.size(), 30u);
  EXPECT_NE(alone[0].find("test:3:broken:0"), std::string::npos);
  EXPECT_EQ(run("three", request_of(20, 3)), alone);
  std::vector<std::string> together;
  for (std::uint64_t i = 1; i <= 3; ++i) {
    const auto part = run("shard" + std::to_string(i), request_of(20, 2, {i, 3}));
    EXPECT_EQ(part.size(), planned_trial_count(request_of(20).plan, {i, 3}));
    together.insert(together.end(), part.begin(), part.end());
  }
  auto sorted = alone;
  std::sort(sorted.begin(), sorted.end());
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, sorted);
}

TEST_F(Trials, GoOnWhereARunEnded) {
  auto request = request_of(8);
  Store store = open("store");
  const auto none = run_trials(request, store, std::chrono::steady_clock::now(), {});
  EXPECT_FALSE(none.complete);
  EXPECT_EQ(none.trials, 0u);
  std::uint64_t calls = 0;
  TrialProgress last;
  const auto whole = run_trials(request, store, in_a_minute(), [&](const TrialProgress& p) {
    ++calls;
    EXPECT_GT(p.done, last.done);
    last = p;
  });
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(whole.trials, 12u);
  EXPECT_EQ(calls, 12u);
  EXPECT_EQ(last.done, last.planned);
  EXPECT_EQ(last.defects, 0u);
  const auto again = run_trials(request, store, in_a_minute(), {});
  EXPECT_TRUE(again.complete);
  EXPECT_EQ(again.trials, 0u);
}

TEST_F(Trials, AreMadeAgainByTheirId) {
  const auto request = request_of(6);
  Store store = open("store");
  run_trials(request, store, in_a_minute(), {});
  std::uint64_t compared = 0;
  store.for_each_trial([&](const TrialRecord& r) {
    EXPECT_EQ(r.id, trial_id(request.plan, request.seed, r.family, r.index));
    for (const auto& family : families()) {
      if (family.name != r.family) continue;
      const auto made = make_case(family, r.id);
      EXPECT_EQ(corpus::case_text(made.c), corpus::case_text(make_case(family, r.id).c));
      EXPECT_EQ(static_cast<std::uint64_t>(made.c.triangles.rows()), r.triangles);
      std::uint64_t pairs = 0;
      for (const auto& step : judge_case(made.c)) pairs += step.pairs.size();
      EXPECT_EQ(pairs, r.pairs);
      for (const auto& tag : made.tags) EXPECT_EQ(r.counts.at("tag:" + tag), 1u);
      ++compared;
    }
  });
  EXPECT_EQ(compared, 9u);
  EXPECT_EQ(trial_id(request.plan, 7, "broken", 12), "test:7:broken:12");
}

TEST_F(Trials, WithoutAWorkerTheHarnessIsToBlame) {
  auto request = request_of(4, 2);
  request.worker = "/nowhere/assay-worker";
  Store store = open("store");
  const auto end = run_trials(request, store, in_a_minute(), {});
  EXPECT_FALSE(end.complete);
  EXPECT_EQ(end.trials, 0u);
  EXPECT_NE(end.harness_problem.find("/nowhere/assay-worker"), std::string::npos);
  EXPECT_EQ(store.trial_count(), 0u);
}

// The built-in detector with a fault in it, in the first configuration.
CampaignRequest faulty(std::string_view name, std::uint64_t cases) {
  auto request = request_of(cases);
  const Fault* fault = find_fault(name);
  EXPECT_TRUE(fault) << name;
  request.detector.configurations = {{"faulty", fault->options, std::string(name)},
                                     {"bvh", {Culling::bvh}}};
  request.plan.laws_every = 1;
  return request;
}

TEST_F(Trials, AFaultIsFoundKeptThriceAndReplays) {
  const auto request = faulty("pair/zero-zero-dropped", 150);
  Store store = open("store");
  const auto end = run_trials(request, store, in_a_minute(), {});
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
    ++kept[failure.signature];
    EXPECT_FALSE(failure.flaky);
    const auto c = corpus::parse_case(failure.mesh, failure.id);
    ASSERT_TRUE(c) << c.error().message;
    EXPECT_NE(c.value().source.find(failure.id), std::string::npos);
    EXPECT_FALSE(c.value().options.empty());
    const auto& configuration = request.detector.configurations[0];
    if (failure.signature.starts_with("law ")) {
      ++of_laws;
      EXPECT_EQ(c.value().id, failure.id);
      const Law* law = law_named(failure.signature.substr(4));
      ASSERT_TRUE(law);
      const auto finding = judge_of_law(*law, configuration)(c.value());
      ASSERT_TRUE(finding) << failure.id << failure.signature;
      EXPECT_EQ(finding->signature, failure.signature);
      EXPECT_NE(c.value().about.find(law->name), std::string::npos);
      continue;
    }
    ++of_claims;
    EXPECT_EQ(c.value().id.find(':'), std::string::npos);
    EXPECT_EQ(failure.configuration, "faulty");
    EXPECT_NE(c.value().about.find(failure.signature), std::string::npos);
    WorkerProcess worker(ASSAY_WORKER, std::nullopt);
    const auto finding = judge_of_detector(request.detector, configuration, worker)(c.value());
    ASSERT_TRUE(finding) << failure.id;
    EXPECT_EQ(finding->signature, failure.signature);
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
  run_trials(request, store, in_a_minute(), {});
  ASSERT_FALSE(store.failures().empty());
  constexpr std::uint64_t few = 40, many = 400;
  constexpr double seconds = 1000;  // beyond the deadline: more than a failure will have had
  shrink_failures(request, store, {seconds, few}, in_a_minute(), {});
  std::set<std::string> signatures, shrunk;
  std::map<std::string, std::size_t> triangles;
  for (const auto& failure : store.failures()) {
    signatures.insert(failure.signature);
    if (failure.smallest.empty()) continue;
    EXPECT_TRUE(shrunk.insert(failure.signature).second) << "shrunk twice: " << failure.signature;
    const auto whole = corpus::parse_case(failure.mesh, "mesh").value();
    const auto small = corpus::parse_case(failure.smallest, "smallest").value();
    EXPECT_LE(small.triangles.rows(), whole.triangles.rows());
    triangles[failure.signature] = static_cast<std::size_t>(small.triangles.rows());
  }
  EXPECT_EQ(shrunk, signatures);  // one each, of laws as of claims
  // Each had few calls only: the same again goes on from there, and never gets larger.
  shrink_failures(request, store, {seconds, many}, in_a_minute(), {});
  bool smaller = false;
  for (const auto& failure : store.failures()) {
    if (failure.smallest.empty()) continue;
    const auto small = corpus::parse_case(failure.smallest, "smallest").value();
    const auto before = triangles.at(failure.signature);
    EXPECT_LE(static_cast<std::size_t>(small.triangles.rows()), before);
    smaller |= static_cast<std::size_t>(small.triangles.rows()) < before;
  }
  EXPECT_TRUE(smaller);
}

// --- what a run rests on

TEST(Binding, ChangesWithWhatTheTrialsAreOf) {
  const auto request = request_of(10);
  const std::string text = binding_of(request);
  auto other = request;
  other.seed = 4;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.shard = {1, 2};
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plan.strata[0].cases = 11;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plan.case_seconds = 11;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.detector.configurations.pop_back();
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.worker = "/bin/true";
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plugin = test::plugin("always_free");
  const std::string free = binding_of(other);
  EXPECT_NE(free, text);
  other.plugin = test::plugin("always_collision");  // of the same name and version
  EXPECT_NE(binding_of(other), free);
  other = request;
  other.plan.seconds = 7;  // a run that ran out of time may go on
  other.jobs = 5;
  EXPECT_EQ(binding_of(other), text);
}

TEST(Canary, IsRegisteredAndFound) {
  const auto canary = meet_canary(request_of(1));
  EXPECT_TRUE(find_fault(canary.fault)) << canary.fault;
  EXPECT_TRUE(canary.found_after);
  // Without a worker nothing can be found.
  auto blind = request_of(1);
  blind.worker = "/bin/true";
  EXPECT_FALSE(meet_canary(blind).found_after);
}

TEST(Starved, LawsAreNamed) {
  const std::string name(laws()[0].name);
  Counts counts;
  for (const auto& law : laws()) {
    counts["law:" + std::string(law.name) + "/premise"] = 100;
    counts["law:" + std::string(law.name) + "/close"] = 25;
  }
  EXPECT_TRUE(starved_laws(counts, 100).empty());
  EXPECT_EQ(starved_laws(counts, 101).size(), laws().size());
  counts["law:" + name + "/close"] = 24;
  ASSERT_EQ(starved_laws(counts, 100).size(), 1u);
  EXPECT_NE(starved_laws(counts, 100)[0].find(name), std::string::npos);
  counts.erase("law:" + name + "/premise");
  EXPECT_NE(starved_laws(counts, 1).at(0).find("held 0 times"), std::string::npos);
  EXPECT_TRUE(starved_laws(counts, 0).empty());
  EXPECT_EQ(broken_laws(counts), 0u);
  counts["law:" + name + "/broken"] = 3;
  EXPECT_EQ(broken_laws(counts), 1u);
}

// --- verdicts on hand-made runs

class Verdicts : public testing::Test {
 protected:
  Verdicts() {
    for (std::uint64_t i = 0; truth.empty() || truth[0].pairs.size() < 2; ++i) {
      c = test::small_case(7, i);
      truth = judge_case(c);
    }
    right = run_case(c, configuration);
    plugin.name = "plug-in";
    plugin.built_in = false;
    plugin.claims = claims_of({});
    plugin.configurations = {configuration};
  }
  Verdict judge(const CaseRun& run, const DetectorUnderTest& detector,
                const CaseRun* again = nullptr) const {
    return judge_trial(c, truth, run, configuration, detector, again);
  }
  static CaseRun ended(RunEnd end, const std::string& what) { return {end, what, {}}; }
  void expect_failure(const CaseRun& run, const DetectorUnderTest& detector, Claim claim,
                      const std::string& signature) const {
    const auto verdict = judge(run, detector);
    EXPECT_EQ(verdict.outcome, Outcome::defect);
    ASSERT_TRUE(verdict.failure);
    EXPECT_EQ(verdict.failure->claim, claim) << name_of(verdict.failure->claim);
    EXPECT_EQ(verdict.failure->signature(), signature);
    EXPECT_EQ(verdict.failure->configuration, "bvh");
    EXPECT_EQ(verdict.failure->step, 0u);
    EXPECT_FALSE(verdict.failure->what.empty());
    EXPECT_EQ(verdict.failure->what.find('\n'), std::string::npos);
  }
  std::string feature_of_first() const { return name_of(truth[0].pairs[0].feature.kind); }

  corpus::Case c;
  std::vector<oracle::StepJudgement> truth;
  CaseRun right;
  Configuration configuration{"bvh", {Culling::bvh, Start::verified, Pairs::all}};
  DetectorUnderTest built_in = built_in_detector(), plugin;
};

TEST_F(Verdicts, ARightRunHolds) {
  for (const auto* detector : {&built_in, &plugin}) {
    const auto verdict = judge(right, *detector, &right);
    EXPECT_EQ(verdict.outcome, Outcome::holds);
    EXPECT_FALSE(verdict.failure);
  }
}

TEST_F(Verdicts, ACrashBreaksTotal) {
  const auto crash = ended(RunEnd::crashed, "killed by signal 11 (Segmentation fault)");
  for (const auto* detector : {&built_in, &plugin}) {
    expect_failure(crash, *detector, Claim::total, "total: crashed");
    EXPECT_EQ(judge(crash, *detector).failure->what, crash.what);
  }
  plugin.claims.total = false;
  EXPECT_EQ(judge(crash, plugin).outcome, Outcome::error);
  EXPECT_FALSE(judge(crash, plugin).failure);
}

TEST_F(Verdicts, ARefusalOfAValidMeshBreaksTotal) {
  expect_failure(ended(RunEnd::refused, "too many"), plugin, Claim::total, "total: refused");
  c.expected.answer = Answer::error;
  EXPECT_EQ(judge(ended(RunEnd::refused, "as it must"), plugin).outcome, Outcome::holds);
}

TEST_F(Verdicts, AHangIsUndecided) {
  for (const auto end : {RunEnd::hung, RunEnd::out_of_memory}) {
    EXPECT_EQ(judge(ended(end, "no answer in 10 s"), plugin).outcome, Outcome::undecided);
    EXPECT_FALSE(judge(ended(end, "no answer in 10 s"), built_in).failure);
  }
  EXPECT_EQ(judge(ended(RunEnd::not_run, "no worker"), plugin).outcome, Outcome::error);
}

TEST_F(Verdicts, AMissingPair) {
  auto wrong = right;
  wrong.steps[0].pairs.erase(wrong.steps[0].pairs.begin());
  // The stage is found by running the built-in again, which has no fault here: the last one.
  expect_failure(
      wrong, built_in, Claim::all_pairs,
      "all-pairs: missing at " +
          stage_that_lost(c.triangles, c.frames[0], c.frames[1], truth[0].pairs[0].pair) + ", " +
          feature_of_first());
  expect_failure(wrong, plugin, judge(wrong, plugin).failure->claim,
                 std::string(name_of(judge(wrong, plugin).failure->claim)) + ": missing, " +
                     feature_of_first());
  const auto verdict = judge(wrong, plugin);
  EXPECT_EQ(verdict.failure->pair, truth[0].pairs[0].pair);
}

TEST_F(Verdicts, FreeAgainstAContact) {
  auto wrong = right;
  wrong.steps[0].answer = Answer::free;
  wrong.steps[0].pairs.clear();
  expect_failure(wrong, plugin, Claim::free_sound, "free-sound: missing, " + feature_of_first());
}

TEST_F(Verdicts, ALatePair) {
  auto wrong = right;
  auto& contact = wrong.steps[0].pairs[0];
  if (contact.time.hi == 1) GTEST_FAIL() << "choose a case whose first pair meets before t = 1";
  contact.time = {1, 1};
  const auto failure = judge(wrong, built_in).failure;
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, "late");
  EXPECT_EQ(failure->pair, contact.pair);
  EXPECT_NE(failure->what.find("oracle"), std::string::npos);
  EXPECT_EQ(failure->signature(), std::string(name_of(failure->claim)) + ": late");
}

TEST_F(Verdicts, ASpuriousPair) {
  corpus::Case quiet;
  for (std::uint64_t i = 0;; ++i) {
    quiet = test::small_case(9, i);
    if (judge_case(quiet)[0].pairs.empty() && quiet.triangles.rows() > 1) break;
  }
  c = quiet;
  truth = judge_case(c);
  auto wrong = run_case(c, configuration);
  ASSERT_EQ(judge(wrong, plugin).outcome, Outcome::holds);
  wrong.steps[0].answer = Answer::collision;
  wrong.steps[0].first = {0, 1};
  detector::PairContact contact;
  contact.pair = {0, 1};
  contact.time = {0, 1};
  wrong.steps[0].pairs = {contact};
  const auto failure = judge(wrong, plugin).failure;
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, "spurious");
  EXPECT_EQ(failure->pair, (detector::TrianglePair{0, 1}));
}

TEST_F(Verdicts, TwoRunsThatDiffer) {
  auto other = right;
  ++other.steps[0].counts.closure_rounds;
  ASSERT_FALSE(same_answers(right, other));
  const auto verdict = judge(right, plugin, &other);
  EXPECT_EQ(verdict.outcome, Outcome::defect);
  ASSERT_TRUE(verdict.failure);
  EXPECT_EQ(verdict.failure->signature(), "deterministic: two runs differ");
  plugin.claims.deterministic = false;
  EXPECT_EQ(judge(right, plugin, &other).outcome, Outcome::holds);
}

TEST_F(Verdicts, TheCaseOfAFailureSaysWhatItIs) {
  c.id = "test:1:broken:7";
  auto wrong = right;
  wrong.steps[0].pairs.erase(wrong.steps[0].pairs.begin());
  const auto failure = judge(wrong, built_in).failure;
  ASSERT_TRUE(failure);
  const auto failing = failing_case(c, configuration, built_in, *failure);
  EXPECT_EQ(failing.id, "test-1-broken-7");
  EXPECT_EQ(failing.source, "campaign case test:1:broken:7, detector built-in, bvh");
  EXPECT_NE(failing.about.find(failure->signature()), std::string::npos);
  EXPECT_EQ(options_of(failing).culling, Culling::bvh);
  EXPECT_EQ(options_of(failing).pairs, Pairs::all);
  const auto again = corpus::parse_case(corpus::case_text(failing), "again");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again.value().frames, c.frames);
  EXPECT_EQ(again.value().triangles, c.triangles);
  EXPECT_TRUE(failing_case(c, configuration, plugin, *failure).options.empty());
}

}  // namespace
}  // namespace assay::properties
