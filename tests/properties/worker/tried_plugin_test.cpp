// Plug-ins of steps, of a query and of candidates, with faults that are excused and faults that are
// found.
#include "properties/campaign/trials/trials.h"
#include "properties/claims/claims.h"
#include "properties/generators/draft.h"
#include "properties/judging/step_measures.h"
#include "properties/judging/verdict.h"
#include "properties/queries/query_families.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

struct Found {
  std::map<Outcome, int> outcomes;
  // Of defects: "late", "not-late: late", "not-late: late, CAUSE", and the whole sentence.
  std::map<std::string, int> kinds, broken, signatures, explanations;
  std::string first_defect;
  StepMeasures measures;
  std::uint64_t discards = 0, left_out = 0, contacts = 0;

  void add(const Verdict& verdict, const CaseRun& run) {
    ++outcomes[verdict.outcome];
    measures += measures_of(verdict.steps, run.steps);
    if (!verdict.failure) return;
    const auto& failure = *verdict.failure;
    ++kinds[failure.kind];
    ++broken[std::string(name_of(failure.claim)) + ": " + failure.kind];
    ++signatures[failure.signature()];
    ++explanations[failure.explanation];
    if (first_defect.empty()) first_defect = failure.signature() + "; " + failure.explanation;
  }
};

struct TriedPlugin {
  TriedPlugin(const std::string& name, const char* variable, const std::string& words,
              std::uint64_t threads = 1)
      : worker((::setenv(variable, words.c_str(), 1), ASSAY_WORKER), test::plugin(name),
               {.seconds = 20, .threads = threads}) {
    const auto described = worker.describe();
    EXPECT_TRUE(described) << words << ": " << described.error().message;
    if (!described) return;
    detector.name = described.value().name;
    detector.built_in = false;
    detector.claims = claims_on_steps(described.value());
    detector.query_claims = claims_on_queries(described.value());
    detector.contract = described.value().contract;
    detector.configurations = {{"plug-in", {}}};
  }

  // So many cases of every family whose name ends so, each once or twice.
  Found steps(const std::string& seed, std::uint64_t cases_a_family, bool twice,
              std::string_view name_end = "") {
    Found found;
    for (const auto& family : families()) {
      if (!family.name.ends_with(name_end)) continue;
      for (std::uint64_t i = 0; i < cases_a_family; ++i) {
        const auto id = seed + ":" + std::string(family.name) + ":" + std::to_string(i);
        const auto trial = case_within(detector.contract, family, id);
        found.measures.redrawn += trial.redrawn;
        found.measures.steps_left_out += trial.steps_left_out;
        found.discards += trial.input ? 0 : 1;
        if (!trial.input) continue;
        const auto examined = examine(
            {detector, detector.configurations, &worker, twice ? &worker : nullptr}, *trial.input);
        found.add(examined.verdicts[0], examined.runs[0]);
      }
    }
    return found;
  }

  WorkerProcess worker;
  DetectorUnderTest detector;
};

// The contract of a plug-in: every field has a fault that it excuses, and one that it does not.

// Cases of every family through the plug-in by_contract with these words.
Found found_by(const std::string& words) {
  return TriedPlugin("by_contract", "ASSAY_BY_CONTRACT", words).steps("contract:1", 12, false);
}

// Each member of the contract excuses what it leaves out, which is counted.
TEST(Contract, ExcusesWhatItLeavesOut) {
  for (const char* words :
       {"", "start=free miss-at-start abort-outside", "start=apart:1e-12 miss-at-start",
        "range=1e-6:1e6 abort-outside", "features=vertex-face", "features=edge-edge",
        "tolerance=1e-6 late=1e-7", "tolerance=1e-6 early=1e-7", "no-pairs",
        "margin=0.1 alarm=2"}) {
    auto found = found_by(words);
    EXPECT_EQ(found.outcomes[Outcome::defect], 0) << words << ": " << found.first_defect;
    EXPECT_GT(found.outcomes[Outcome::holds], 80) << words;
    EXPECT_EQ(found.discards, 0u) << words;
    if (!std::string_view(words).starts_with("start=free")) continue;
    EXPECT_GT(found.measures.steps_left_out + found.measures.redrawn, 0u);
    const auto& errors = found.measures.errors;
    EXPECT_GT(errors.contact, 30u);
    EXPECT_EQ(errors.late.steps + errors.early.steps + errors.false_alarms, 0u);
  }
}

// And nothing else: with the kind of defect that is found.
TEST(Contract, ExcusesNothingElse) {
  const std::pair<std::string, const char*> rows[] = {
      {"miss-at-start", "answered free"},
      {"miss-inside", "answered free"},
      {"late=1e-6", "late"},
      {"early=1e-6", "early"},
      {"alarm=2", "answered collision"},
      {"miss=edge-edge", "answered free"},
      {"start=free miss-inside", "answered free"},
      {"start=apart:1e-12 miss-inside", "answered free"},
      {"range=1e-6:1e6 miss-inside", "answered free"},
      {"features=vertex-face miss=vertex-face", "answered free"},
      {"features=edge-edge miss=edge-edge", "answered free"},
      {"tolerance=1e-6 late=1e-5", "late"},
      {"tolerance=1e-6 early=1e-5", "early"},
      {"no-pairs with-pairs", "error"},
      {"no-pairs miss-inside", "answered free"},  // not a word of missing pairs
      {"margin=0.1 miss-inside", "answered free"}};
  for (const auto& [words, kind] : rows) {
    auto found = found_by(words);
    EXPECT_GT(found.kinds[kind], 0) << words << ": " << found.first_defect;
    EXPECT_GT(found.outcomes[Outcome::defect], 0) << words;
    EXPECT_TRUE(!words.starts_with("no-pairs") || !found.kinds.contains("missing pair")) << words;
  }
}

// Engines that are exact but for the way in, on as many cases as smoke has.
TEST(EverydayNumbers, RoundingOnTheWayInIsFound) {
  const auto tried = [](const std::string& way) {
    return TriedPlugin("rounds_on_the_way", "ASSAY_TEST_ROUNDING", way)
        .steps("rounding:1", 200, false, "-everyday");
  };
  auto right = tried("not at all");
  EXPECT_EQ(right.outcomes[Outcome::defect], 0) << right.first_defect;
  EXPECT_GT(right.outcomes[Outcome::holds], 300);
  for (const std::string way :
       {"displacement", "velocity", "first vertex", "millimetres", "extent", "float boxes"}) {
    auto found = tried(way);
    std::printf("%-14s %d of %d cases\n", way.c_str(), found.outcomes[Outcome::defect],
                found.outcomes[Outcome::defect] + found.outcomes[Outcome::holds]);
    EXPECT_GE(found.kinds["answered free"], 2) << way << ": " << found.first_defect;
  }
}

TEST(Contract, WhatIsSenselessIsRefusedInOneLine) {
  const std::map<std::string, std::string> senseless = {
      {"range=1:0.5", "upside down"},
      {"tolerance=0.01", "is above 0.001"},
      {"tolerance=nan", "no time"},
      {"start=apart:0", "start_distance is 0"},
      {"start=apart:-1", "is no length"},
      {"range=-1:1", "range of coordinates is invalid"},
      {"margin=inf", "its margin is no length"},
      {"separation=-1 adjacency=2", "its separation is no length"},
      {"separation=0.1", "it has a separation, but tests neighbours"}};
  for (const auto& [words, line] : senseless) {
    ::setenv("ASSAY_BY_CONTRACT", words.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, test::plugin("by_contract"));
    const auto description = worker.describe();
    ASSERT_FALSE(description) << words;
    EXPECT_TRUE(says(description.error(), line)) << words;
  }
}

// A library of one elementary query: every claim has a fault that breaks it, every member of the
// contract one that it excuses, and what it sends in place of answers is a crash or an error.

// Queries of every family through the plug-in query_alone with these words, each twice.
Found queries_with(const std::string& words) {
  TriedPlugin tried("query_alone", "ASSAY_QUERY", words);
  const auto& detector = tried.detector;
  Found found;
  const Exam exam{detector, detector.configurations, &tried.worker, &tried.worker};
  std::vector<CaseResults> list;
  for (const auto& family : query_families()) {
    for (std::uint64_t i = 0; i < 25; ++i) {
      const auto made =
          make_case(family, "queries:1:" + std::string(family.name) + ":" + std::to_string(i));
      auto seen = contract_case(made.c, detector.contract);
      found.left_out += seen ? 0 : 1;
      if (!seen) continue;
      run_first(exam, list.emplace_back(CaseResults{std::move(*seen)}));
    }
  }
  for (auto& one : list) run_again(exam, one);
  for (auto& one : list) {
    judge(exam, one);
    found.contacts += one.truth[0].pairs.size();
    found.add(one.verdicts[0], one.runs[0]);
  }
  return found;
}

// Returns how many queries the contract leaves out.
std::uint64_t expect_query_holds(const std::string& words) {
  auto found = queries_with(words);
  EXPECT_EQ(found.outcomes[Outcome::defect], 0) << words << ": " << found.first_defect;
  EXPECT_GT(found.outcomes[Outcome::holds], 80) << words;
  EXPECT_GT(found.contacts, 20u) << words;
  return found.left_out;
}

using WordsAndDefect = std::pair<const char*, const char*>;

void expect_queries_break(std::initializer_list<WordsAndDefect> rows) {
  for (const auto& [words, kind] : rows) {
    auto found = queries_with(words);
    EXPECT_GT(found.broken[kind], 0) << words << ": " << found.first_defect;
    EXPECT_GT(found.outcomes[Outcome::defect], 0) << words;
  }
}

TEST(Queries, RightAnswersHold) { EXPECT_EQ(expect_query_holds(""), 0u); }

TEST(Queries, EveryClaimHasAFaultThatBreaksIt) {
  expect_queries_break({{"miss-inside", "free-sound: answered free"},
                        {"miss-at-start", "free-sound: answered free"},
                        {"miss-coplanar", "free-sound: answered free"},
                        {"late=1e-6", "not-late: late"},
                        {"early=1e-6", "first-time: early"},
                        {"alarm", "no-spurious: answered collision"},
                        {"changing", "deterministic: two runs differ"},
                        {"error", "total: error"},
                        {"refuse", "total: error"},
                        {"abort-at-start", "total: crashed"},
                        // What is no answer breaks total.
                        {"no-interval", "total: error"},
                        {"nan", "total: error"},
                        {"no-answer", "total: error"}});
}

TEST(Queries, UndecidedAnswersAreNoDefects) {
  for (const char* words : {"undecided", "no-memory"}) {
    auto found = queries_with(words);
    EXPECT_EQ(found.outcomes[Outcome::defect], 0) << words << ": " << found.first_defect;
    EXPECT_EQ(found.outcomes[Outcome::undecided], static_cast<int>(found.contacts)) << words;
  }
}

TEST(Queries, TheContractLeavesOutWhatItSaysAndNothingElse) {
  for (const char* words : {"features=vertex-face miss=edge-edge abort-outside",
                            "start=free miss-at-start abort-outside",
                            "features=edge-edge miss=vertex-face abort-outside",
                            "start=apart:1e-9 miss-at-start", "range=1e-6:1e6 abort-outside"})
    EXPECT_GT(expect_query_holds(words), 0u) << words;
  expect_query_holds("float32 abort-outside");
  expect_query_holds("tolerance=1e-4 late=1e-6");
  expect_queries_break({{"features=vertex-face miss=vertex-face", "free-sound: answered free"},
                        {"start=free miss-inside", "free-sound: answered free"},
                        {"start=apart:1e-9 miss-inside", "free-sound: answered free"},
                        {"tolerance=1e-4 late=2e-4", "not-late: late"},
                        {"margin=1e-9 alarm", "no-spurious: answered collision"},
                        {"range=1e-6:1e6 miss-inside", "free-sound: answered free"}});
}

TEST(Queries, OfACaseAreThoseThatItWasMadeOf) {
  for (const auto& family : query_families()) {
    for (std::uint64_t i = 0; i < 20; ++i) {
      const auto made = make_case(family, std::string(family.name) + std::to_string(i));
      const auto query = query_of(made.c);
      ASSERT_TRUE(query) << family.name;
      EXPECT_EQ(corpus::case_text(case_of_query(*query, made.c.id)), corpus::case_text(made.c));
    }
  }
  auto c = make_case(query_families()[0], "any").c;
  c.triangles(1, 2) = 0;
  EXPECT_TRUE(says_query(c));
  EXPECT_FALSE(query_of(c));
  EXPECT_FALSE(contract_case(c, {}));
}

// A library of candidates alone: judged by the pairs that it loses, and nothing else.

// Cases of every family through the plug-in candidates_alone with this fault, each twice.
Found found_with(const char* fault, std::uint64_t threads = 1) {
  return TriedPlugin("candidates_alone", "ASSAY_CANDIDATES", fault, threads)
      .steps("candidates:1", 6, true);
}

TEST(Candidates, OfBoxesOverTheWholeStepHold) {
  auto found = found_with("");
  EXPECT_EQ(found.outcomes[Outcome::defect], 0) << found.signatures.begin()->first;
  EXPECT_EQ(found.outcomes[Outcome::holds], static_cast<int>(6 * families().size()));
  EXPECT_GT(found.measures.candidate_steps, 40u);
  EXPECT_GT(found.measures.least_candidates, 100u);
  EXPECT_GT(found.measures.candidates, found.measures.least_candidates);
  EXPECT_EQ(found.measures.errors.answers(), 0u) << "it answers none";
}

TEST(Candidates, ThatMissAContactAreFoundWithItsCause) {
  for (const char* fault : {"ends-only", "every-second"}) {
    auto found = found_with(fault);
    EXPECT_GT(found.outcomes[Outcome::defect], 0) << fault;
    EXPECT_GT(found.outcomes[Outcome::holds], 0) << fault;
    for (const auto& [signature, count] : found.signatures)
      EXPECT_TRUE(signature.starts_with("candidates: missing candidate, ")) << signature;
    const auto& signature = found.signatures.begin()->first;
    EXPECT_TRUE(says(signature, ", t "));
    EXPECT_TRUE(says(found.explanations.begin()->first, " candidates"));
  }
}

// Those that change are not deterministic, and those that are none break total.
TEST(Candidates, BreakNothingElse) {
  for (const std::string fault : {"changing", "no-such-triangle", "no-list", "fail", "abort"}) {
    auto found = found_with(fault.c_str());
    EXPECT_GT(found.outcomes[Outcome::defect], 0) << fault;
    const auto* claim = fault == "changing" ? "deterministic: two runs differ" : "total: ";
    for (const auto& [signature, count] : found.signatures)
      EXPECT_TRUE(signature.starts_with(claim)) << fault << ": " << signature;
  }
}

// The threads are 1 by default.
TEST(Candidates, WithoutMemoryAreUndecidedAndAreToldHowManyThreadsTheyMayUse) {
  EXPECT_EQ(found_with("no-memory").outcomes[Outcome::undecided],
            static_cast<int>(6 * families().size()));
  EXPECT_EQ(found_with("threads=3", 3).outcomes[Outcome::defect], 0);
  EXPECT_GT(found_with("threads=3", 1).outcomes[Outcome::defect], 0);
}

}  // namespace
}  // namespace assay::properties
