// Each gate fails for each of its reasons, and the first one that fails names the verdict.
#include "properties/campaign/gates/gates.h"

#include "corpus/scenes/scenes.h"
#include "properties/campaign/phases/phases.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using test::failure, test::forget, test::good_findings, test::good_tally;

using Change = std::function<void(RunFindings&)>;

Judgement judged_after(const std::vector<Change>& changes,
                       const VerbRequest& asked = asked_of_a_certificate()) {
  auto findings = good_findings();
  for (const auto& change : changes) change(findings);
  return judge(findings, asked);
}

void expect(const Judgement& judgement, Gate gate, const char* word, int code) {
  ASSERT_TRUE(judgement.failed_gate) << judgement.verdict;
  EXPECT_EQ(rule_of(*judgement.failed_gate).name, rule_of(gate).name)
      << judgement.of(*judgement.failed_gate).reasons[0];
  EXPECT_EQ(judgement.verdict, word);
  EXPECT_EQ(judgement.exit_code, code);
}

// Incomplete for this reason alone.
void expect_incomplete(const Judgement& judgement, const std::string& reason) {
  expect(judgement, Gate::complete, "incomplete", 3);
  EXPECT_EQ(judgement.of(Gate::complete).reasons, std::vector<std::string>{reason});
}

void expect_certified(const std::vector<Change>& changes) {
  const auto judgement = judged_after(changes);
  EXPECT_EQ(judgement.verdict, "certified");
  if (judgement.failed_gate) ADD_FAILURE() << judgement.of(*judgement.failed_gate).reasons[0];
}

// A defect of a trial with the failure that is stored of it.
void add_defect(RunFindings& f, const std::string& signature = "free-sound: missing") {
  auto& outcomes = f.tally.strata["broken"].by_configuration[0];
  --outcomes.holds;
  ++outcomes.defects;
  ++f.times_met[signature];
  ++f.claims_broken;
  f.failures.push_back(failure(signature));
}

// Who leaves neighbours out looks at strangers first, and everybody at ordinary numbers.
TEST(Gates, TellTheLeastOddFailuresFirst) {
  const std::string generic = "free-sound: answered free, edge-edge, t inside, moving, generic";
  const auto judgement = judged_after({[&](RunFindings& f) {
    for (const char* special : {", huge numbers", ", sharing an edge", ", sharing a vertex", ""})
      add_defect(f, generic + special);
  }});
  const auto& reasons = judgement.of(Gate::claims).reasons;
  ASSERT_EQ(reasons.size(), 4u);
  std::size_t place = 0;
  for (const char* special : {"", ", sharing a vertex", ", sharing an edge", ", huge numbers"})
    EXPECT_TRUE(reasons[place++].starts_with(generic + special + ", met")) << reasons[place - 1];
}

TEST(Gates, StandInTheOrderOfTheExitCodes) {
  const std::vector<int> order = {4, 1, 3};
  std::size_t place = 0;
  for (std::size_t i = 0; i < gate_rules.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(gate_rules[i].gate), i);
    while (place < order.size() && order[place] != gate_rules[i].exit_code) ++place;
    EXPECT_LT(place, order.size()) << gate_rules[i].name << " stands too late";
  }
}

TEST(Gates, AllHoldOnAGoodRun) {
  const auto judgement = judged_after({});
  for (const auto& result : judgement.gates) {
    EXPECT_EQ(result.state, GateState::holds) << rule_of(result.gate).name;
    EXPECT_TRUE(result.reasons.empty()) << result.reasons[0];
  }
  EXPECT_EQ(judgement.verdict, "certified");
  EXPECT_EQ(judgement.exit_code, 0);
  EXPECT_FALSE(judgement.failed_gate);
}

TEST(Gates, WhatWasNotAskedForIsNotJudged) {
  const std::vector<Change> wrong = {[](auto& f) {
    f.evidence.sources[0].failed = {{"A1", "s", "w"}};
    f.evidence.speed.clear();
  }};
  const auto run = judged_after(wrong, asked_of_a_run());
  EXPECT_EQ(run.verdict, "holds");
  EXPECT_EQ(run.exit_code, 0);
  for (const auto gate : {Gate::corpus, Gate::speed}) {
    EXPECT_EQ(run.of(gate).state, GateState::not_judged);
    EXPECT_EQ(run.of(gate).reasons.size(), 1u);
  }
  // Nor does a run owe what only `certify` does.
  EXPECT_EQ(judged_after({[](auto& f) { forget(f, Source::self_test); }}, asked_of_a_run()).verdict,
            "holds");
  const auto nothing = judged_after({[](auto& f) { add_defect(f); }}, VerbRequest{});
  EXPECT_EQ(nothing.verdict, "not judged");
  EXPECT_EQ(nothing.exit_code, 0);
}

TEST(Gates, AnUnsoundHarnessCertifiesNothing) {
  const std::vector<Change> unsound = {
      [](auto& f) { f.evidence.canaries[0].found_after.reset(); },
      [](auto& f) { f.evidence.faults[1].curated = false; },
      [](auto& f) { f.evidence.faults[2].needed = {3}; },
      [](auto& f) {
        f.evidence.problems = {{"no worker", 0}};
      },
      [](auto& f) { f.evidence.sources[1].defects = 1; },
      [](auto& f) { f.tally.counts.laws[std::string(laws()[0].name)].premise = 3; },
      [](auto& f) { f.tally.counts.laws[std::string(laws()[0].name)].close = 1; },
      // A defect without a failure that was stored, and the other way round.
      [](auto& f) { f.tally.strata["broken"].by_configuration[0].defects = 1; },
      [](auto& f) { f.claims_broken = 1; }};
  for (std::size_t i = 0; i < unsound.size(); ++i) {
    SCOPED_TRACE(i);
    expect(judged_after({unsound[i]}), Gate::harness, "unsound-harness", 4);
  }
  // Half of the power is wanted, and there.
  expect_certified({[](auto& f) {
    f.evidence.faults[1].curated = false;
    f.run.plan.policy.power = 0.5;
  }});
}

TEST(Gates, ACheckOfTheHarnessThatLacksTrialsIsNotJudged) {
  const Change starved = [](auto& f) {
    f.tally.counts.laws[std::string(laws()[0].name)].premise = 3;
  };
  const Change short_of_one = [](auto& f) { f.tally.strata["broken"].trials = 19; };
  expect(judged_after({starved, short_of_one}), Gate::complete, "incomplete", 3);
  const auto without_canary = judged_after({[](auto& f) { f.evidence.canaries.clear(); }});
  EXPECT_EQ(without_canary.of(Gate::harness).state, GateState::not_judged);
  expect(without_canary, Gate::complete, "incomplete", 3);
  // The time was over: no proof against the harness.
  expect(judged_after({[](auto& f) {
           f.evidence.faults[1].curated = false;
           f.evidence.faults[1].time_over = true;
         }}),
         Gate::complete, "incomplete", 3);
}

TEST(Gates, WhatIsAbsentIsIncomplete) {
  const std::vector<Change> absent = {
      [](auto& f) { f.tally.strata["broken"].trials = 19; },
      [](auto& f) {
        f.parts = {{1, 2, "r"}};
      },
      [](auto& f) { f.evidence.faults.erase(f.evidence.faults.begin()); },
      [](auto& f) { forget(f, Source::corpus); }, [](auto& f) { forget(f, Source::self_test); },
      [](auto& f) { f.evidence.sources[1].complete = false; },
      [](auto& f) {
        f.evidence.power = {{"other", "built-in", 1, "another program", "", "", ""}};
      },
      // Found early, and not given all of its cases or seeds.
      [](auto& f) { f.evidence.faults[0].time_over = true; },
      [](auto& f) { f.evidence.faults[2].needed.clear(); },
      [](auto& f) {
        f.evidence.sources[0].open = {{"A1", "", "no verdict: no answer in 60 s"}};
      },
      [](auto& f) { f.tally.strata["broken"].discards = 1; },
      [](auto& f) { f.tally.strata["broken"].disturbed = 1; },  // one of twenty
      [](auto& f) {
        f.run.plan.strata.clear();
        f.tally.strata.clear();
      }};
  for (std::size_t i = 0; i < absent.size(); ++i) {
    SCOPED_TRACE(i);
    expect(judged_after({absent[i]}), Gate::complete, "incomplete", 3);
  }
  expect_certified({[](auto& f) {
    f.run.plan.strata[0].cases = f.tally.strata["broken"].trials = 100;
    f.tally.strata["broken"].disturbed = 1;
  }});
}

TEST(Gates, ACaseOfTheCorpusThatFailsIsADefect) {
  const Change failed = [](auto& f) { f.evidence.sources[0].failed = {{"A1", "s", "w"}}; };
  expect(judged_after({failed}), Gate::corpus, "defect", 1);
}

TEST(Gates, ABrokenClaimIsADefect) {
  const Change defect = [](auto& f) { add_defect(f); };
  expect(judged_after({defect}), Gate::claims, "defect", 1);
  // What the corpus alone shows is that gate's; any other counts, were it met in no trial.
  const auto stored = [](const std::string& id) {
    return [id](auto& f) { f.failures = {failure("late", id)}; };
  };
  expect(judged_after({stored("tiny:1:broken:3")}), Gate::claims, "defect", 1);
  expect(judged_after({stored("corpus:1:broken:3")}), Gate::claims, "defect", 1);
  expect_certified({stored("corpus/M_Leither")});
  // A mesh of the corpus does not stand for trials of the same signature.
  expect(judged_after({defect,
                       [](auto& f) {
                         f.failures.insert(f.failures.begin(),
                                           failure("free-sound: missing", "corpus/A1"));
                       }}),
         Gate::claims, "defect", 1);
  // A failure counts whether or not a mesh of it was kept.
  expect(judged_after({defect, [](auto& f) { f.failures.clear(); }}), Gate::claims, "defect", 1);
  // A law is no claim of a trial's outcome.
  expect(judged_after({[](auto& f) {
           f.times_met["law L3_X"] = 1;
           f.failures = {failure("law L3_X")};
         }}),
         Gate::claims, "defect", 1);
  expect(judged_after({[](auto& f) { f.evidence.worlds[0].counterexample = "pairs differ"; }}),
         Gate::claims, "defect", 1);
}

// One of two shares of a campaign that is twice as large.
void half_alone(RunFindings& f) {
  for (auto& stratum : f.run.plan.strata) stratum.cases *= 2;
  f.run.plan.fault_cases *= 2;
  f.parts = {{3, 2, "r"}};
}

TEST(Gates, AShareAloneIsIncompleteAndTwoAreWhole) {
  expect_incomplete(judged_after({half_alone}),
                    "a whole campaign is more than the shares that are there: 1/2 under seed 3; "
                    "shares 1/N need N seeds that follow one another");
  const Change second = [](auto& f) {
    f.parts.push_back({4, 2, "r"});
    for (auto& [family, tally] : f.tally.strata) tally = good_tally(2 * tally.trials);
    for (auto& proof : f.evidence.faults) proof.cases *= 2;
  };
  expect_certified({half_alone, second});
  // Both judge odd indices.
  const Change other_seed = [](auto& f) { f.parts.back().seed = 5; };
  expect(judged_after({half_alone, second, other_seed}), Gate::complete, "incomplete", 3);
  // A fault that nobody found counts once all of its cases were tried.
  const Change hidden = [](auto& f) { f.evidence.faults[0].curated = false; };
  expect(judged_after({half_alone, hidden}), Gate::complete, "incomplete", 3);
  expect(judged_after({half_alone, second, hidden}), Gate::harness, "unsound-harness", 4);
  const Change cut = [](auto& f) { f.evidence.faults[0].cases = 1; };  // one share had no time
  expect(judged_after({half_alone, second, hidden, cut}), Gate::complete, "incomplete", 3);
  // A defect of a share is a defect.
  expect(judged_after({half_alone, [](auto& f) { add_defect(f); }}), Gate::claims, "defect", 1);
}

TEST(Gates, OfSeveralRunsTheMedianOfATimeCounts) {
  const auto measured = [](double median) {
    return [median](auto& f) {
      f.evidence.speed.push_back({"exact-over-double", median, 0, 9, {}});
    };
  };
  expect_certified({measured(9), measured(1.1)});
  expect(judged_after({measured(9), measured(9)}), Gate::speed, "undecided", 3);
}

TEST(Gates, ADefectGoesBeforeWhatIsMissing) {
  expect(judged_after({[](auto& f) {
           add_defect(f);
           f.tally.strata["broken"].trials = 19;
           f.parts = {{1, 2, "r"}};
         }}),
         Gate::claims, "defect", 1);
}

// A search of 1,000 cases has two lanes.
TEST(Gates, TheSearchAsksAllOfItsCases) {
  const Change planned = [](auto& f) { f.run.plan.search = 1000; };
  const auto lane = [](const char* name) {
    return [name](auto& f) {
      f.evidence.sources.push_back(
          {.source = Source::search, .input = name, .planned = 500, .cases = 500});
    };
  };
  expect_certified({planned, lane("001"), lane("002")});
  expect_incomplete(judged_after({planned, lane("001")}),
                    "the search came to lanes of 500 of 1000 cases");
  const Change no_verdict = [](auto& f) { f.evidence.sources.back().undecided = 3; };
  EXPECT_EQ(
      judged_after({planned, lane("001"), lane("002"), no_verdict}).of(Gate::complete).reasons,
      std::vector<std::string>{"3 cases of the search have no verdict"});
  const Change none_taken = [](auto& f) {
    for (auto& one : f.evidence.sources) one.cases = 0;
  };
  EXPECT_EQ(
      judged_after({planned, lane("001"), lane("002"), none_taken}).of(Gate::complete).reasons,
      std::vector<std::string>{"the contract takes no case of the search"});
}

TEST(Gates, CompleteSaysWhichOfItsReasonsEndWhenTheRunGoesOn) {
  const Change planned = [](auto& f) { f.run.plan.search = 1000; };
  const auto remedy = [&](std::uint64_t cases, std::uint64_t open) {
    const Change searched = [&](auto& f) {
      f.evidence.sources.push_back({.source = Source::search,
                                    .input = "001",
                                    .planned = cases,
                                    .cases = cases,
                                    .undecided = open});
    };
    return judged_after({planned, searched}).of(Gate::complete).remedy;
  };
  EXPECT_EQ(remedy(1000, 0), "");
  EXPECT_EQ(remedy(500, 0), "the same command, run again, goes on with what is missing");
  EXPECT_EQ(remedy(1000, 3),
            "the same command, run again, mends none of this; other seeds, a larger campaign or "
            "another contract may");
  EXPECT_EQ(
      remedy(500, 3),
      "the same command, run again, goes on with what is missing, and does not mend: 3 cases "
      "of the search have no verdict; other seeds, a larger campaign or another contract may");
}

TEST(Gates, WhatTheSearchFindsIsADefect) {
  const Change found = [](auto& f) {
    f.failures.push_back(failure("all-pairs: missing pair", "search/tiny:1:001:7"));
    f.failures.back().source = Source::search;
  };
  const auto judged = judged_after({found});
  expect(judged, Gate::claims, "defect", 1);
  EXPECT_EQ(judged.of(Gate::claims).reasons,
            std::vector<std::string>{
                "all-pairs: missing pair, found by the search; search/tiny:1:001:7 (bvh)"});
}

TEST(Gates, APlugInIsGivenEverySceneAndALimiterEveryWalk) {
  const Change plug_in = [](auto& f) {
    f.run.detector.built_in = false;
    f.run.plan.policy.repeated_triangles = 100;
  };
  const auto given = [](auto& f, const std::string& input) {
    f.evidence.sources.push_back({.source = Source::repeated, .input = input});
  };
  const Change scenes = [&](auto& f) {
    for (const auto& scene : corpus::scenes()) given(f, std::string(scene.name));
    given(f, name_of_long_sequence);
  };
  expect(judged_after({plug_in}), Gate::complete, "incomplete", 3);
  expect_certified({plug_in, scenes});
  const Change limits = [](auto& f) {
    f.run.detector.configurations[0].claims.emplace_back("commit-free");
    for (auto& [family, stratum] : f.tally.strata)
      stratum.measures.errors.limits.contact = stratum.trials;
  };
  const auto walks = [&](std::size_t count) -> Change {
    return [=](auto& f) {
      for (std::size_t i = 0; i < count; ++i) given(f, name_of(all_values<WalkKind>[i]));
    };
  };
  const auto all = all_values<WalkKind>.size();
  expect_certified({plug_in, scenes, limits, walks(all)});
  const auto wanted = corpus::scenes().size() + 1 + all;
  expect_incomplete(
      judged_after({plug_in, scenes, limits, walks(all - 1)}),
      std::to_string(wanted - 1) + " of " + std::to_string(wanted) + " scenes were repeated");
}

TEST(Gates, WithoutContactsInsideTheContractNothingIsCertified) {
  const auto contacts = [](std::size_t stratum, std::uint64_t trials) -> Change {
    return [=](auto& f) {
      const auto& family = f.run.plan.strata[stratum].family;
      f.tally.strata[family].measures.contact_trials = trials;
    };
  };
  const Change plug_in = [](auto& f) { f.run.detector.built_in = false; };
  expect_incomplete(judged_after({contacts(0, 1)}),
                    "broken: 1 of 20 planned cases have a contact inside the contract, a tenth is "
                    "wanted");
  expect_certified({contacts(0, 2)});
  expect_certified({plug_in, contacts(0, 2)});
  const auto none = judged_after({plug_in, contacts(0, 0), contacts(1, 0), contacts(2, 0)});
  expect(none, Gate::complete, "incomplete", 3);
  EXPECT_EQ(none.of(Gate::complete).reasons.size(), 4u);
  // A family that the contract leaves out wholly is named, and no contact of it is wanted. Of the
  // others there have to be three.
  const Change left_out = [](auto& f) {
    auto& tally = f.tally.strata["broken"] = {};
    tally.trials = tally.discards = 20;
  };
  expect_incomplete(judged_after({left_out}),
                    "2 of 3 families have a contact inside the contract, 3 are wanted");
  expect_certified({left_out, [](auto& f) {
                      f.run.plan.strata.push_back({"closed-degenerate", 2, 0.99});
                      f.tally.strata["closed-degenerate"] = good_tally(2);
                    }});
  // A campaign of fewer families cannot end in a certificate, but a run of it may hold.
  const Change one_family = [](auto& f) {
    f.run.plan.strata.resize(1);
    f.tally.strata.erase("closed-generic");
    f.tally.strata.erase("unclosed-generic");
  };
  expect(judged_after({one_family}), Gate::complete, "incomplete", 3);
  EXPECT_EQ(judged_after({one_family}, asked_of_a_run()).verdict, "holds");
  // Nothing is wanted where nothing was claimed of contacts, or the contract makes it void.
  const Change claims_total = [](auto& f) { f.run.detector.configurations[0].claims = {"total"}; };
  expect_certified({plug_in, claims_total, contacts(0, 0)});
  const Change void_pairs = [](auto& f) {
    f.run.detector.configurations[0].claims = {"all-pairs", "total"};
    f.run.detector.contract.reports = PairReporting::no_pairs;
  };
  expect_certified({plug_in, void_pairs, contacts(0, 0)});
  // But some claim has to be judged: one whose every interval says nothing of the time is none.
  const Change only_wide_times = [](auto& f) {
    f.run.detector.configurations[0].claims = {"first-time"};
    for (auto& [family, tally] : f.tally.strata) {
      tally.measures.errors.steps = tally.measures.errors.contact = 2;
      tally.measures.without_time = 2;
    }
  };
  expect_incomplete(judged_after({plug_in, only_wide_times}),
                    "no claim of the detector was judged");
  // A share by itself may have too few, and is incomplete for that alone.
  EXPECT_EQ(judged_after({contacts(0, 0), half_alone}).of(Gate::complete).reasons.size(), 1u);
}

// The steps and the query of a library are judged apart from each other.
TEST(Gates, ContactsOfQueriesDoNotStandForThoseOfSteps) {
  const auto with_queries = [](auto& f) {
    f.run.detector.built_in = false;
    f.run.detector.query_claims = {"free-sound"};
    for (const std::string family : {"query-ulp", "query-far", "query-generic"}) {
      f.run.plan.strata.push_back({family, 2, 0.99});
      f.tally.strata[family] = good_tally(2);
    }
  };
  expect_certified({with_queries});
  const auto none =
      judged_after({with_queries, [](auto& f) {
                      for (const char* family : {"broken", "closed-generic", "unclosed-generic"})
                        f.tally.strata[family].measures = {};
                    }});
  expect(none, Gate::complete, "incomplete", 3);
  EXPECT_EQ(none.of(Gate::complete).reasons.back(), "free-sound: no step had a contact");
  const auto no_query =
      judged_after({with_queries, [](auto& f) { f.tally.strata["query-ulp"].measures = {}; }});
  expect(no_query, Gate::complete, "incomplete", 3);
  EXPECT_EQ(no_query.of(Gate::complete).reasons.back(),
            "2 of 3 families of queries have a contact inside the contract, 3 are wanted");
}

TEST(Gates, BoundsAndSpeed) {
  const Change undecided = [](auto& f) {
    f.tally.strata["broken"].by_configuration[0] = {19, 0, 1, 0};
  };
  expect(judged_after({[](auto& f) { f.run.plan.strata[0].wanted_bound = 0.01; }}), Gate::bounds,
         "undecided", 3);
  // Where no bound is wanted none may be left open; where one is, it counts against the bound.
  expect_certified({undecided});
  expect(judged_after({undecided, [](auto& f) { f.run.plan.strata[0].wanted_bound = 0; }}),
         Gate::bounds, "undecided", 3);
  // Wanted of a whole campaign.
  const auto alone =
      judged_after({half_alone, [](auto& f) { f.run.plan.strata[0].wanted_bound = 0.01; }});
  EXPECT_EQ(alone.of(Gate::bounds).state, GateState::not_judged);
  expect(alone, Gate::complete, "incomplete", 3);
  expect(judged_after({[](auto& f) { f.evidence.speed[0].median = 1.31; }}), Gate::speed,
         "undecided", 3);
  expect(judged_after({[](auto& f) { f.evidence.speed.clear(); }}), Gate::speed, "undecided", 3);
  for (const Change& no_limit : {Change([](auto& f) { f.run.detector.built_in = false; }),
                                 Change([](auto& f) { f.run.plan.policy.speed_limits.clear(); })}) {
    const auto judgement = judged_after({no_limit});
    EXPECT_EQ(judgement.of(Gate::speed).state, GateState::not_judged);
    EXPECT_EQ(judgement.verdict, "certified");
  }
}

// A stratum of sizes states its bound at 95 % for itself, changes that of no other, and wants none.
TEST(Gates, StrataOfSizesEnterNoCorrection) {
  const auto plain = good_findings();
  auto with = plain;
  with.run.plan.strata.push_back({"size-1e4", 10, 0});
  with.tally.strata["size-1e4"] = good_tally(10);
  with.tally.strata["size-1e4"].by_configuration = {{7, 0, 2, 1}};
  EXPECT_EQ(number_of_bounds(with.run), number_of_bounds(plain.run));
  for (const auto& stratum : plain.run.plan.strata)
    EXPECT_EQ(bound_of(with.outcomes_of(stratum, 0), stratum, with.run),
              bound_of(plain.outcomes_of(stratum, 0), stratum, plain.run));
  const auto& size = with.run.plan.strata.back();
  EXPECT_EQ(bound_of(with.outcomes_of(size, 0), size, with.run), upper_bound(3, 10, .05));
  EXPECT_TRUE(is_met(with, size, 0));
  EXPECT_EQ(judge(with, asked_of_a_certificate()).verdict, "certified");
  // A bound that a campaign file wants of it is asked for.
  with.run.plan.strata.back().wanted_bound = 0.1;
  EXPECT_EQ(judge(with, asked_of_a_certificate()).verdict, "undecided");
  // A defect in it is a defect.
  with.tally.strata["size-1e4"].with_defect = 1;
  with.tally.strata["size-1e4"].by_configuration = {{9, 1, 0, 0}};
  with.failures = {failure("free-sound: answered free, large mesh", "tiny:1:size-1e4:3")};
  with.times_met = {{"free-sound: answered free, large mesh", with.claims_broken = 1}};
  EXPECT_EQ(judge(with, asked_of_a_certificate()).verdict, "defect");
}

// What is refused beyond the capacity is no trial of a bound, and nothing is certified of its size.
TEST(Gates, RefusalsBeyondTheCapacityAreCountedAlone) {
  TrialRecord record;
  record.id = "tiny:1:size-1e4:0";
  record.family = "size-1e4";
  record.outcomes = letter_of(Outcome::refused);
  record.triangles = 10'000;
  StratumTally tally;
  tally.add(record);
  EXPECT_EQ(tally.by_configuration[0].trials(), 0u);
  EXPECT_EQ(tally.by_configuration[0].refused, 1u);
  EXPECT_EQ(tally.refused, 1u);
  auto f = good_findings();
  f.run.plan.strata.push_back({"size-1e4", 1, 0});
  f.tally.strata["size-1e4"] = tally;
  EXPECT_TRUE(f.is_left_out(f.run.plan.strata.back()));
  EXPECT_EQ(judge(f, asked_of_a_certificate()).verdict, "certified");
}

TEST(Gates, TheFirstThatFailsNamesTheVerdict) {
  // Each gate broken in turn, from the last to the first.
  const std::vector<Change> changes = {[](auto& f) { f.evidence.speed[0].median = 2; },
                                       [](auto& f) { f.run.plan.strata[0].wanted_bound = 0.01; },
                                       [](auto& f) { f.tally.strata["broken"].trials = 19; },
                                       [](auto& f) { f.evidence.worlds[0].counterexample = "c"; },
                                       [](auto& f) {
                                         f.evidence.sources[0].failed = {{"A", "s", "w"}};
                                       },
                                       [](auto& f) {
                                         f.evidence.problems = {{"p", 0}};
                                       }};
  std::vector<Change> so_far;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    so_far.push_back(changes[i]);
    const auto judgement = judged_after(so_far);
    const auto gate = static_cast<Gate>(gate_rules.size() - 1 - i);
    expect(judgement, gate, std::string(rule_of(gate).verdict).c_str(), rule_of(gate).exit_code);
    // The later ones are still told.
    for (std::size_t later = gate_rules.size() - 1 - i; later < gate_rules.size(); ++later)
      EXPECT_EQ(judgement.gates[later].state, GateState::fails);
  }
}

// No store can have a certificate issued with a gate left out.
TEST(Gates, ACertificateAsksForEveryGate) {
  const auto judgement =
      judged_after({[](auto& f) { forget(f, Source::corpus); }}, VerbRequest{{"harness"}, true});
  for (const auto& result : judgement.gates) {
    if (result.gate == Gate::corpus) continue;
    EXPECT_NE(result.state, GateState::not_judged) << rule_of(result.gate).name;
  }
  EXPECT_EQ(judgement.verdict, "incomplete");
}

}  // namespace
}  // namespace assay::properties
