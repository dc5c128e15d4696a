// Each gate fails for each of its reasons, and the first gate that fails names the verdict. Also
// how kinds of failure are grouped.
#include "properties/campaign/gates/gates.h"

#include "corpus/scenes/scenes.h"
#include "properties/campaign/phases/phases.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using test::failure, test::forget, test::good_findings, test::good_tally;

using Change = std::function<void(RunFindings&)>;
using Changes = std::vector<Change>;

Judgement judged_after(const Changes& changes,
                       const VerbRequest& asked = asked_of_a_certificate()) {
  auto findings = good_findings();
  for (const auto& change : changes) change(findings);
  return judge(findings, asked);
}

// What a run ends with if this gate is the first that fails.
const std::map<Gate, std::pair<std::string, int>> ends = {
    {Gate::harness, {"unsound-harness", 4}}, {Gate::corpus, {"defect", 1}},
    {Gate::claims, {"defect", 1}},           {Gate::complete, {"incomplete", 3}},
    {Gate::bounds, {"undecided", 3}},        {Gate::speed, {"undecided", 3}}};

// Returns the reasons of the gate.
std::vector<std::string> expect_fails(Gate gate, const Changes& changes,
                                      int line = __builtin_LINE()) {
  SCOPED_TRACE(line);
  const auto judgement = judged_after(changes);
  const auto failed = judgement.failed_gate.value_or(gate);
  EXPECT_EQ(rule_of(failed).name, rule_of(gate).name)
      << testing::PrintToString(judgement.of(failed).reasons);
  EXPECT_EQ(std::pair(judgement.verdict, judgement.exit_code), ends.at(gate));
  return judgement.of(gate).reasons;
}

// Incomplete for this reason alone.
void expect_incomplete(const Changes& changes, const std::string& reason,
                       int line = __builtin_LINE()) {
  EXPECT_EQ(expect_fails(Gate::complete, changes, line), std::vector{reason}) << line;
}

void expect_certified(const Changes& changes, int line = __builtin_LINE()) {
  const auto judgement = judged_after(changes);
  EXPECT_EQ(judgement.verdict, "certified") << line;
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

const Change defect = [](auto& f) { add_defect(f); };
const Change short_of_one = [](auto& f) { f.tally.strata["broken"].trials = 19; };
const Change plug_in = [](auto& f) { f.run.detector.built_in = false; };
const Change tight_bound = [](auto& f) { f.run.plan.strata[0].wanted_bound = 0.01; };
const Change wrong_world = [](auto& f) { f.evidence.worlds[0].counterexample = "pairs differ"; };
const Change corpus_failed = [](auto& f) { f.evidence.sources[0].failed = {{"A1", "s", "w"}}; };
const Change harness_failed = [](auto& f) { f.evidence.problems = {{"no worker", 0}}; };
const Change starved_law = [](auto& f) {
  f.tally.counts.laws[std::string(laws()[0].name)].premise = 3;
};

// Who leaves neighbours out looks at strangers first, and everybody at ordinary numbers.
TEST(Gates, TellTheLeastOddFailuresFirst) {
  const std::string generic = "free-sound: answered free, edge-edge, t inside, moving, generic";
  const char* ascending[] = {"", ", sharing a vertex", ", sharing an edge", ", huge numbers"};
  const auto reasons = expect_fails(Gate::claims, {[&](RunFindings& f) {
                                      for (const int i : {3, 2, 1, 0})
                                        add_defect(f, generic + ascending[i]);
                                    }});
  ASSERT_EQ(reasons.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_TRUE(reasons[i].starts_with(generic + ascending[i] + ", met")) << reasons[i];
}

TEST(Gates, AllHoldOnAGoodRun) {
  const auto judgement = judged_after({});
  for (const auto& result : judgement.gates)
    EXPECT_TRUE(result.state == GateState::holds && result.reasons.empty())
        << rule_of(result.gate).name;
  EXPECT_EQ(judgement.verdict, "certified");
  EXPECT_EQ(judgement.exit_code, 0);
  EXPECT_FALSE(judgement.failed_gate);
}

TEST(Gates, WhatWasNotAskedForIsNotJudged) {
  const Change no_speed = [](auto& f) { f.evidence.speed.clear(); };
  const auto run = judged_after({corpus_failed, no_speed}, asked_of_a_run());
  EXPECT_EQ(run.verdict, "holds");
  EXPECT_EQ(run.exit_code, 0);
  for (const auto gate : {Gate::corpus, Gate::speed}) {
    EXPECT_EQ(run.of(gate).state, GateState::not_judged);
    EXPECT_EQ(run.of(gate).reasons.size(), 1u);
  }
  // Nor does a run owe what only `certify` does.
  EXPECT_EQ(judged_after({[](auto& f) { forget(f, Source::self_test); }}, asked_of_a_run()).verdict,
            "holds");
  const auto nothing = judged_after({defect}, VerbRequest{});
  EXPECT_EQ(nothing.verdict, "not judged");
  EXPECT_EQ(nothing.exit_code, 0);
}

TEST(Gates, AnUnsoundHarnessCertifiesNothing) {
  const Changes unsound = {
      [](auto& f) { f.evidence.canaries[0].found_after.reset(); },
      [](auto& f) { f.evidence.faults[1].curated = false; },
      [](auto& f) { f.evidence.faults[2].needed = {3}; }, harness_failed,
      [](auto& f) { f.evidence.sources[1].defects = 1; }, starved_law,
      [](auto& f) { f.tally.counts.laws[std::string(laws()[0].name)].close = 1; },
      // A defect without a failure that was stored, and the other way round.
      [](auto& f) { f.tally.strata["broken"].by_configuration[0].defects = 1; },
      [](auto& f) { f.claims_broken = 1; }};
  for (std::size_t i = 0; i < unsound.size(); ++i) {
    SCOPED_TRACE(i);
    expect_fails(Gate::harness, {unsound[i]});
  }
  // Half of the power is wanted, and there.
  expect_certified({unsound[1], [](auto& f) { f.run.plan.policy.power = 0.5; }});
}

TEST(Gates, ACheckOfTheHarnessThatLacksTrialsIsNotJudged) {
  expect_fails(Gate::complete, {starved_law, short_of_one});
  const Change no_canary = [](auto& f) { f.evidence.canaries.clear(); };
  EXPECT_EQ(judged_after({no_canary}).of(Gate::harness).state, GateState::not_judged);
  expect_fails(Gate::complete, {no_canary});
  // The time was over: no proof against the harness.
  expect_fails(Gate::complete, {[](auto& f) {
                 f.evidence.faults[1].curated = false;
                 f.evidence.faults[1].time_over = true;
               }});
}

TEST(Gates, WhatIsAbsentIsIncomplete) {
  const Changes absent = {
      short_of_one,
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
    expect_fails(Gate::complete, {absent[i]});
  }
  expect_certified({[](auto& f) {
    f.run.plan.strata[0].cases = f.tally.strata["broken"].trials = 100;
    f.tally.strata["broken"].disturbed = 1;
  }});
}

TEST(Gates, ABrokenClaimIsADefect) {
  expect_fails(Gate::claims, {defect});
  // What the corpus alone shows is that gate's; any other counts, were it met in no trial.
  expect_fails(Gate::corpus, {corpus_failed});
  const auto stored = [](const std::string& id) {
    return [id](auto& f) { f.failures = {failure("late", id)}; };
  };
  expect_fails(Gate::claims, {stored("tiny:1:broken:3")});
  expect_fails(Gate::claims, {stored("corpus:1:broken:3")});
  expect_certified({stored("corpus/M_Leither")});
  // A mesh of the corpus does not stand for trials of the same signature.
  expect_fails(Gate::claims, {defect, [](auto& f) {
                                f.failures.insert(f.failures.begin(),
                                                  failure("free-sound: missing", "corpus/A1"));
                              }});
  // A failure counts whether or not a mesh of it was kept.
  expect_fails(Gate::claims, {defect, [](auto& f) { f.failures.clear(); }});
  // A law is no claim of a trial's outcome.
  expect_fails(Gate::claims, {[](auto& f) {
                 f.times_met["law L3_X"] = 1;
                 f.failures = {failure("law L3_X")};
               }});
  expect_fails(Gate::claims, {wrong_world});
}

// One of two shares of a campaign that is twice as large.
void half_alone(RunFindings& f) {
  for (auto& stratum : f.run.plan.strata) stratum.cases *= 2;
  f.run.plan.fault_cases *= 2;
  f.parts = {{3, 2, "r"}};
}

TEST(Gates, AShareAloneIsIncompleteAndTwoAreWhole) {
  expect_incomplete({half_alone},
                    "the shares make no whole campaign: 1/2 under seed 3; "
                    "shares 1/N need N consecutive seeds");
  const Change second = [](auto& f) {
    f.parts.push_back({4, 2, "r"});
    for (auto& [family, tally] : f.tally.strata) tally = good_tally(2 * tally.trials);
    for (auto& proof : f.evidence.faults) proof.cases *= 2;
  };
  expect_certified({half_alone, second});
  // Both judge odd indices.
  expect_fails(Gate::complete, {half_alone, second, [](auto& f) { f.parts.back().seed = 5; }});
  // A fault that nobody found counts once all of its cases were tried.
  const Change hidden = [](auto& f) { f.evidence.faults[0].curated = false; };
  expect_fails(Gate::complete, {half_alone, hidden});
  expect_fails(Gate::harness, {half_alone, second, hidden});
  const Change cut = [](auto& f) { f.evidence.faults[0].cases = 1; };  // one share had no time
  expect_fails(Gate::complete, {half_alone, second, hidden, cut});
  // A defect of a share is a defect, and goes before all that is missing.
  expect_fails(Gate::claims, {half_alone, defect, short_of_one});
}

TEST(Gates, OfSeveralRunsTheMedianOfATimeCounts) {
  const auto measured = [](double median) {
    return [median](auto& f) {
      f.evidence.speed.push_back({"exact-over-double", median, 0, 9, {}});
    };
  };
  expect_certified({measured(9), measured(1.1)});
  expect_fails(Gate::speed, {measured(9), measured(9)});
}

// The search has asked so many cases of a lane, and some have no verdict.
Change lane(const char* name, std::uint64_t cases, std::uint64_t undecided = 0) {
  return [=](auto& f) {
    f.evidence.sources.push_back({.source = Source::search,
                                  .input = name,
                                  .planned = cases,
                                  .cases = cases,
                                  .undecided = undecided});
  };
}
const Change search_planned = [](auto& f) { f.run.plan.search = 1000; };

// A search of 1,000 cases has two lanes.
TEST(Gates, TheSearchAsksAllOfItsCases) {
  expect_certified({search_planned, lane("001", 500), lane("002", 500)});
  expect_incomplete({search_planned, lane("001", 500)},
                    "the search has finished 500 of its 1000 cases");
  expect_incomplete({search_planned, lane("001", 500), lane("002", 500, 3)},
                    "3 cases of the search have no verdict");
  const Change none_taken = [](auto& f) {
    for (auto& one : f.evidence.sources) one.cases = 0;
  };
  EXPECT_EQ(judged_after({search_planned, lane("001", 500), lane("002", 500), none_taken})
                .of(Gate::complete)
                .reasons,
            std::vector<std::string>{"the contract takes no case of the search"});
}

TEST(Gates, CompleteSaysWhichOfItsReasonsEndWhenTheRunGoesOn) {
  const auto remedy = [](std::uint64_t cases, std::uint64_t open) {
    return judged_after({search_planned, lane("001", cases, open)}).of(Gate::complete).remedy;
  };
  EXPECT_EQ(remedy(1000, 0), "");
  EXPECT_EQ(remedy(500, 0), "the same command, run again, goes on with what is missing");
  EXPECT_EQ(remedy(1000, 3),
            "the same command, run again, cannot mend this; other seeds, a larger campaign or "
            "another contract may");
  EXPECT_EQ(
      remedy(500, 3),
      "the same command, run again, goes on with what is missing, but cannot mend: 3 cases "
      "of the search have no verdict; other seeds, a larger campaign or another contract may");
}

TEST(Gates, WhatTheSearchFindsIsADefect) {
  const Change found = [](auto& f) {
    f.failures.push_back(failure("all-pairs: missing pair", "search/tiny:1:001:7"));
    f.failures.back().source = Source::search;
  };
  EXPECT_EQ(expect_fails(Gate::claims, {found}),
            std::vector<std::string>{
                "all-pairs: missing pair, found by the search; search/tiny:1:001:7 (bvh)"});
}

TEST(Gates, APlugInIsGivenEverySceneAndALimiterEveryWalk) {
  const Change repeats = [](auto& f) { f.run.plan.policy.repeated_triangles = 100; };
  const auto given = [](auto& f, const std::string& input) {
    f.evidence.sources.push_back({.source = Source::repeated, .input = input});
  };
  const Change scenes = [&](auto& f) {
    for (const auto& scene : corpus::scenes()) given(f, std::string(scene.name));
    given(f, name_of_long_sequence);
  };
  expect_fails(Gate::complete, {plug_in, repeats});
  expect_certified({plug_in, repeats, scenes});
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
  expect_certified({plug_in, repeats, scenes, limits, walks(all)});
  const auto wanted = corpus::scenes().size() + 1 + all;
  expect_incomplete(
      {plug_in, repeats, scenes, limits, walks(all - 1)},
      std::to_string(wanted - 1) + " of " + std::to_string(wanted) + " sequences were run");
}

TEST(Gates, WithoutContactsInsideTheContractNothingIsCertified) {
  const auto contacts = [](std::size_t stratum, std::uint64_t trials) -> Change {
    return [=](auto& f) {
      const auto& family = f.run.plan.strata[stratum].family;
      f.tally.strata[family].measures.contact_trials = trials;
    };
  };
  expect_incomplete({contacts(0, 1)},
                    "broken: 1 of 20 planned cases have a contact inside the contract, a tenth is "
                    "wanted");
  expect_certified({contacts(0, 2)});
  expect_certified({plug_in, contacts(0, 2)});
  const Changes none = {plug_in, contacts(0, 0), contacts(1, 0), contacts(2, 0)};
  EXPECT_EQ(expect_fails(Gate::complete, none).size(), 4u);
  // A family that the contract leaves out wholly is named, and no contact of it is wanted. Of the
  // others there have to be three.
  const Change left_out = [](auto& f) {
    auto& tally = f.tally.strata["broken"] = {};
    tally.trials = tally.discards = 20;
  };
  expect_incomplete({left_out}, "2 of 3 families have a contact inside the contract, 3 are wanted");
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
  expect_fails(Gate::complete, {one_family});
  EXPECT_EQ(judged_after({one_family}, asked_of_a_run()).verdict, "holds");
  // Nothing is wanted where nothing was claimed of contacts, or the contract makes it void.
  const auto claims = [](std::vector<std::string> words) -> Change {
    return [words](auto& f) { f.run.detector.configurations[0].claims = words; };
  };
  expect_certified({plug_in, claims({"total"}), contacts(0, 0)});
  const Change no_pairs = [](auto& f) {
    f.run.detector.contract.reports = PairReporting::no_pairs;
  };
  expect_certified({plug_in, claims({"all-pairs", "total"}), no_pairs, contacts(0, 0)});
  // But some claim has to be judged: one whose every interval says nothing of the time is none.
  const Change only_wide_times = [](auto& f) {
    for (auto& [family, tally] : f.tally.strata) {
      tally.measures.errors.steps = tally.measures.errors.contact = 2;
      tally.measures.without_time = 2;
    }
  };
  expect_incomplete({plug_in, claims({"first-time"}), only_wide_times},
                    "no claim of the detector was judged");
  // A share by itself may have too few, and is incomplete for that alone.
  EXPECT_EQ(expect_fails(Gate::complete, {contacts(0, 0), half_alone}).size(), 1u);
}

// The steps and the query of a library are judged apart from each other.
TEST(Gates, ContactsOfQueriesDoNotStandForThoseOfSteps) {
  const Change with_queries = [](auto& f) {
    f.run.detector.query_claims = {"free-sound"};
    for (const std::string family : {"query-ulp", "query-far", "query-generic"}) {
      f.run.plan.strata.push_back({family, 2, 0.99});
      f.tally.strata[family] = good_tally(2);
    }
  };
  const auto without_contacts = [](std::vector<std::string> families) -> Change {
    return [families](auto& f) {
      for (const auto& family : families) f.tally.strata[family].measures = {};
    };
  };
  expect_certified({plug_in, with_queries});
  const auto steps = without_contacts({"broken", "closed-generic", "unclosed-generic"});
  EXPECT_EQ(expect_fails(Gate::complete, {plug_in, with_queries, steps}).back(),
            "free-sound: no step had a contact");
  const auto a_query = without_contacts({"query-ulp"});
  EXPECT_EQ(expect_fails(Gate::complete, {plug_in, with_queries, a_query}).back(),
            "2 of 3 families of queries have a contact inside the contract, 3 are wanted");
}

TEST(Gates, BoundsAndSpeed) {
  const Change undecided = [](auto& f) {
    f.tally.strata["broken"].by_configuration[0] = {19, 0, 1, 0};
  };
  expect_fails(Gate::bounds, {tight_bound});
  // Where no bound is wanted none may be left open; where one is, it counts against the bound.
  expect_certified({undecided});
  expect_fails(Gate::bounds, {undecided, [](auto& f) { f.run.plan.strata[0].wanted_bound = 0; }});
  // Wanted of a whole campaign.
  expect_fails(Gate::complete, {half_alone, tight_bound});
  EXPECT_EQ(judged_after({half_alone, tight_bound}).of(Gate::bounds).state, GateState::not_judged);
  expect_fails(Gate::speed, {[](auto& f) { f.evidence.speed[0].median = 1.31; }});
  expect_fails(Gate::speed, {[](auto& f) { f.evidence.speed.clear(); }});
  for (const Change& no_limit :
       {plug_in, Change([](auto& f) { f.run.plan.policy.speed_limits.clear(); })}) {
    EXPECT_EQ(judged_after({no_limit}).of(Gate::speed).state, GateState::not_judged);
    expect_certified({no_limit});
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
  const Changes changes = {[](auto& f) { f.evidence.speed[0].median = 2; },
                           tight_bound,
                           short_of_one,
                           wrong_world,
                           corpus_failed,
                           harness_failed};
  Changes so_far;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    so_far.push_back(changes[i]);
    const std::size_t gate = gate_rules.size() - 1 - i;
    expect_fails(static_cast<Gate>(gate), so_far);
    // The later ones are still told.
    for (std::size_t later = gate; later < gate_rules.size(); ++later)
      EXPECT_EQ(judged_after(so_far).gates[later].state, GateState::fails);
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

// Kinds of failure are grouped by what they do; what those that lose a contact share is tested
// where cases that hold stand beside them (tests/reports/verbs/run_command_test.cpp).

RunFindings failing_by(const std::vector<std::string>& signatures) {
  auto findings = good_findings();
  for (const auto& signature : signatures)
    findings.failures.push_back(failure(signature, signature));
  return findings;
}

TEST(FailureGroups, WhatTheyDoComesFromTheKindNotFromTheStageOrALawBeforeIt) {
  auto findings = failing_by(
      {"all-pairs: late pair", "all-pairs: missing pair at view sets, edge-edge, t inside, moving",
       "free-sound: answered free, vertex-face, t at 0, moving",
       "law Change_Mirror, not-late: late, edge-edge, t inside, moving", "law L3_X",
       "no-spurious: answered collision, moving", "no-spurious: early alarm",
       "progress: share too small", "total: crashed", "deterministic: two runs differ",
       "total: refused"});
  findings.failures.back().flaky = true;
  const auto groups = failure_groups(findings);
  std::map<std::string, std::size_t> kinds;
  for (const auto& group : groups) kinds[group.does] = group.kinds.size();
  const std::map<std::string, std::size_t> wanted = {{"lose a contact", 4},
                                                     {"break a law", 1},
                                                     {"report a false or too early contact", 2},
                                                     {"stop the caller too early", 1},
                                                     {"end without an answer", 1},
                                                     {"give another answer in a second run", 2}};
  EXPECT_EQ(kinds, wanted);
  EXPECT_EQ(text_of(groups[0], 11), "4 of 11 kinds of failure lose a contact");
  EXPECT_TRUE(groups[0].shared.empty());
  // A single kind is in none.
  EXPECT_TRUE(failure_groups(failing_by({})).empty());
  EXPECT_TRUE(failure_groups(failing_by({"total: crashed"})).empty());
  const auto two = failure_groups(failing_by({"total: crashed", "total: refused"}));
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(text_of(two[0], 2), "all 2 kinds of failure end without an answer");
}

}  // namespace
}  // namespace assay::properties
