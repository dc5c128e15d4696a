// Findings of a run in which all gates hold, for tests that break one gate.
#pragma once

#include <regex>

#include "properties/campaign/gates/gates.h"
#include "properties/campaign/ledger/tally.h"

namespace assay::properties::test {

inline FaultProof fault_proof(const std::string& name, FaultStatus status, bool curated,
                              std::vector<std::optional<std::uint64_t>> needed = {std::nullopt}) {
  FaultProof proof;
  proof.fault = name;
  proof.law = "L3";
  proof.status = status;
  proof.curated = curated;
  proof.needed = std::move(needed);
  proof.cases = 100;
  return proof;
}

// Returns a failure of a trial or, if the id begins with "corpus/", of the corpus. The signature is
// "law L3_X, claim: kind, contact", or a part of this text.
inline FailureRecord failure(const std::string& signature,
                             const std::string& id = "tiny:1:broken:3") {
  static const std::regex form("(?:law ([^,]*)(?:, |$))?([^:]*)(?:: ([^,]*))?(?:, (.*))?");
  const std::string of_corpus = "corpus/";
  const bool is_of_corpus = id.starts_with(of_corpus);
  std::smatch part;
  std::regex_match(signature, part, form);
  return {.source = is_of_corpus ? Source::corpus : Source::trial,
          .case_id = is_of_corpus ? id.substr(of_corpus.size()) : id,
          .configuration = "bvh",
          .law = part[1],
          .claim = part[2],
          .kind = part[3],
          .contact = part[4],
          .explanation = "a & b < c",
          .mesh = "{}"};
}

// Returns a tally of trials that hold in one configuration. Each trial has a contact.
inline StratumTally good_tally(std::uint64_t trials) {
  StratumTally tally;
  tally.trials = trials;
  tally.by_configuration = {{trials, 0, 0, 0}};
  tally.measures.errors.steps = tally.measures.errors.contact = trials;
  tally.measures.contact_trials = trials;
  return tally;
}

// Returns findings of three strata (20, 2 and 2 trials in one configuration), two planted faults,
// corpus, self-test and speed.
inline RunFindings good_findings() {
  RunFindings f;
  f.run.plan.name = "tiny";
  f.run.plan.strata = {
      {"broken", 20, 0.5}, {"closed-generic", 2, 0.99}, {"unclosed-generic", 2, 0.99}};
  f.run.plan.fault_cases = 100;
  f.run.plan.fault_seeds = 1;
  f.run.plan.law_premises = 4;
  f.run.plan.policy.self_test_queries = 10;
  f.run.plan.policy.speed_limits = {{"exact-over-double", 1.3}};
  f.run.seed = 1;
  f.run.detector.name = "built-in";
  f.run.planted_faults = 2;
  f.run.detector.configurations = {{"bvh", {"free-sound"}}};
  f.parts = {{1, 1, "r"}};
  for (const auto& stratum : f.run.plan.strata)
    f.tally.strata[stratum.family] = good_tally(stratum.cases);
  LawTally law_tally;
  law_tally.premise = 8;
  law_tally.close = 2;
  for (const auto& law : laws())
    for (const char* culling : {"auto", "view-auto", "view-point", "view-line"})
      add_law(f.tally.counts, law, law_tally, culling);
  f.evidence.canaries = {{"c", 7}};
  f.evidence.faults = {
      fault_proof("a", FaultStatus::planted, true), fault_proof("b", FaultStatus::planted, true),
      fault_proof("e", FaultStatus::equivalent, false), fault_proof("o", FaultStatus::open, false)};
  f.evidence.worlds = {{"square-2", 1, 1, 1, 0, true, std::nullopt}};
  f.evidence.sources = {
      {.source = Source::corpus, .input = "curated cases", .configuration = "bvh"},
      {.source = Source::self_test, .input = "line", .cases = 10, .collisions = 1}};
  f.evidence.speed = {{"exact-over-double", 1.2, 1.1, 1.3, {}}};
  return f;
}

// Removes a source, as if its cases had not been judged.
inline void forget(RunFindings& f, Source source) {
  std::erase_if(f.evidence.sources, [&](const auto& row) { return row.source == source; });
}

}  // namespace assay::properties::test
