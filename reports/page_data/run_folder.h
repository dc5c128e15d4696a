// The folder of a run, read back: every shard's store, summed.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/campaign/store.h"
#include "reports/page_data/run_evidence.h"

namespace assay::reports {

struct PlannedStratum {
  std::string family;
  std::uint64_t cases = 0;
  double wanted_bound = 0;  // 0: none is wanted
};

struct StoredDetector {
  std::string name;
  bool built_in = true;
  std::string library;  // of a plug-in, as it was named to the run; empty: not known
  std::vector<std::string> configurations;
  std::uint64_t claims = 0;  // of all configurations together
};

struct StoredRun {
  std::filesystem::path folder;
  std::string campaign;
  std::uint64_t seed = 0;
  std::uint64_t shard_count = 1;
  std::set<std::uint64_t> shards;  // present, from 1; of a merged store {1}
  std::vector<PlannedStratum> strata;
  std::uint64_t wanted_premises = 0;  // of each law; 0: not asked
  StoredDetector detector;
  RunEvidence evidence;
  properties::Tally tally;
  properties::Counts met;  // signatures
  // By signature, shrunk ones first; of the trials, and what the corpus alone shows.
  std::vector<properties::StoredFailure> failures;

  std::uint64_t planned_trials() const;
  std::uint64_t trials() const;
};

// Errors, one line each: no folder, no store in it, a store that cannot be read, stores of
// different runs. A merged store goes before the shards that it may be made of. Reads every trial.
corpus::Expected<StoredRun> read_run(const std::filesystem::path& folder);

}  // namespace assay::reports
