// All that the stores of a folder say of one campaign. read_findings.h reads it, gates.h judges it,
// and every text, file and page is a rendering of findings and gates.
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
  BoundRun run;                  // its `shard` means nothing where several were read
  std::vector<StoreFile> files;  // by name
  std::uint64_t shard_count = 1;
  std::vector<Shard> shards, missing;
  // Where a run of one shard of several is looked at by itself: that shard. What is wanted of all
  // of them together is not asked of it.
  std::optional<Shard> alone;
  Tally tally;
  Counts met;  // failures, by signature
  // By signature; of each the shrunk ones first, then the shorter, then by id.
  std::vector<StoredFailure> failures;
  EvidenceFacts evidence;
  std::string library;  // of a plug-in, as it was named to the run; empty: not known
  // SHA-256 over all rows but times and paths: the same for the same campaign, however long it took
  // and wherever it was kept.
  std::string rows;

  // Cases of a family that were planned, in the shard that is looked at or in all of them.
  std::uint64_t planned(const StratumPlan& stratum) const;
  std::uint64_t planned() const;
  // Of a family; one without trials where none was judged.
  const StratumTally& tally_of(const StratumPlan& stratum) const;
  // The first of each signature, the least odd before the others (cause.h).
  std::vector<const StoredFailure*> kinds() const;
  std::uint64_t met_count(const StoredFailure& failure) const;
  bool is_waived(const std::string& signature) const;
  // A stored failure of this signature, one of a trial rather than of the corpus; null: none.
  const StoredFailure* example_of(const std::string& signature) const;
  // Of a configuration in a stratum.
  StratumTally::Outcomes outcomes_of(const StratumPlan& stratum, std::size_t configuration) const;
  // Whether laws were met often enough is asked of the built-in detector, once all trials of all
  // shards took place.
  bool laws_are_judged() const;
  // Whether the same command would add something: it was killed, or ended by its time.
  bool has_more_to_do() const;
  // Planted faults that were tried, and that were found.
  std::uint64_t planted() const, found() const;
};

}  // namespace assay::properties
