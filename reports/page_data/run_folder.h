// The folder of a run, read back: every shard's store, summed.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/campaign/store.h"
#include "reports/page_data/run_notes.h"

namespace assay::reports {

struct PlannedStratum {
  std::string family;
  std::uint64_t cases = 0;
  double wanted_bound = 0;  // 0: none is wanted
};

struct StoredRun {
  std::filesystem::path folder;
  std::string campaign;
  std::uint64_t seed = 0;
  std::uint64_t shard_count = 1;
  std::set<std::uint64_t> shards;  // present, from 1
  std::vector<PlannedStratum> strata;
  std::uint64_t wanted_premises = 0;  // of each law; 0: not asked
  DetectorNote detector;
  nlohmann::ordered_json faults, canary;  // null: not noted
  std::vector<RunEndNote> ends;           // one a shard; fewer: not noted
  properties::Tally tally;
  properties::Counts met;                           // signatures
  std::vector<properties::StoredFailure> failures;  // by signature; shrunk ones first

  std::uint64_t planned_trials() const;
  std::uint64_t trials() const;
};

// Errors, one line each: no folder, no store in it, a store that cannot be read, stores of
// different runs. Reads every trial.
corpus::Expected<StoredRun> read_run(const std::filesystem::path& folder);

}  // namespace assay::reports
