// Findings of a run all of whose gates hold, for tests that break one of them.
#pragma once

#include <string>

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

inline StoredFailure failure(const std::string& signature,
                             const std::string& id = "tiny:1:broken:3") {
  return {id, "bvh", signature, "a & b < c", "{}", "", false};
}

// A tally of trials that hold in one configuration, each with a contact.
inline StratumTally good_tally(std::uint64_t trials) {
  StratumTally tally;
  tally.trials = trials;
  tally.by_configuration = {{trials, 0, 0, 0}};
  tally.measures.errors.steps = tally.measures.errors.contact = trials;
  tally.measures.contact_trials = trials;
  return tally;
}

// Three strata of 20, 2 and 2 trials in one configuration, two planted faults, corpus, self-test
// and speed.
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
  for (const auto& law : laws()) {
    for (const char* culling : {"auto", "view-auto", "view-point", "view-line"})
      add_law(f.tally.counts, law, law_tally, culling);
  }
  f.evidence.canaries = {{"c", 7}};
  f.evidence.faults = {
      fault_proof("a", FaultStatus::planted, true), fault_proof("b", FaultStatus::planted, true),
      fault_proof("e", FaultStatus::equivalent, false), fault_proof("o", FaultStatus::open, false)};
  f.evidence.worlds = {{"square-2", 1, 1, 1, 0, true, std::nullopt}};
  f.evidence.self_test = {{"line", 10, 1, 0, 0, true}};
  CorpusRow corpus;
  corpus.input = "curated cases";
  corpus.configuration = "bvh";
  f.evidence.corpus = {corpus};
  f.evidence.speed = {{"exact-over-double", 1.2, 1.1, 1.3, {}}};
  return f;
}

}  // namespace assay::properties::test
