// All that the stores of a folder say of one campaign. read_findings.h reads it and gates.h judges
// it; every text, file and page only presents findings and gates.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/stored/step_measures.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {

struct StoreFile {
  std::string name;    // without its folder
  std::string sha256;  // of its bytes
};

struct RunFindings {
  std::filesystem::path folder;
  BoundRun run;                  // its `shard` means nothing if several were read
  std::vector<StoreFile> files;  // by name
  std::uint64_t shard_count = 1;
  std::vector<Shard> shards, missing;
  // If one shard of several is looked at by itself: that shard. It is not asked for what is wanted
  // of all shards together.
  std::optional<Shard> alone;
  Tally tally;
  Counts times_met;  // how often each signature of a failure was met
  // Ordered by signature; within one signature the shrunk ones first, then the shorter, then by
  // id.
  std::vector<StoredFailure> failures;
  EvidenceFacts evidence;
  std::string library;  // the plug-in's library as the run was told; empty: not known
  // SHA-256 over all rows but times and paths. It is the same for the same campaign, however long
  // that took and wherever it was kept.
  std::string rows;

  // The number of cases that were planned, for one family and for all, in the one shard that is
  // looked at (`alone`) or in all of them.
  std::uint64_t planned(const StratumPlan& stratum) const;
  std::uint64_t planned() const;
  // Whether the contract left out every case of a family, once all of them were drawn.
  bool is_left_out(const StratumPlan& stratum) const;
  // The tally of a family; an empty one if no trial of it was judged.
  const StratumTally& tally_of(const StratumPlan& stratum) const;
  // One failure of each signature (example_of), the least odd cause first (cause.h).
  std::vector<const StoredFailure*> kinds() const;
  std::uint64_t met_count(const StoredFailure& failure) const;
  bool is_waived(const std::string& signature) const;
  // A stored failure of this signature, if possible one of a trial rather than of the corpus; null
  // if there is none.
  const StoredFailure* example_of(const std::string& signature) const;
  // The outcomes of one configuration in one stratum.
  StratumTally::Outcomes outcomes_of(const StratumPlan& stratum, std::size_t configuration) const;
  // Whether it can be judged if the laws were met often enough. That is so for the built-in
  // detector once all trials of all shards took place.
  bool laws_are_judged() const;
  // Whether the same command would add something, because the run was killed or ended by its time.
  bool has_more_to_do() const;
  // How many planted faults were tried, how many were found, and how many of these by random cases.
  // The others were found by their curated case alone.
  std::uint64_t planted() const, found() const, found_at_random() const;
};

}  // namespace assay::properties
