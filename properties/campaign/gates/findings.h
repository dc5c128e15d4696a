// The findings of one campaign: all that the stores of its folder say. read_findings makes the
// findings and gates.h judges them. Every text, file and page only presents findings and gates.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/ledger/tally.h"

namespace assay::properties {

struct StoreFile {
  std::string name;    // the name of the file, without its folder
  std::string sha256;  // the hash of its bytes
};
ASSAY_FIELDS(StoreFile, name, sha256)

// One of the runs that are judged together.
struct RunPart {
  std::uint64_t seed = 1, shares = 1;  // as in CampaignRequest
  std::string rows;                    // the run's digest (RunFindings::rows)
};

struct RunFindings {
  std::filesystem::path folder;
  BoundRun run;                  // the first run, if several runs are judged together
  std::vector<StoreFile> files;  // by name
  std::vector<RunPart> parts;    // by seed: one item for each run
  Tally tally;
  Counts times_met;                 // the number of failures of each signature
  std::uint64_t claims_broken = 0;  // the number of failures that break a claim, but no law
  // Ordered by the oddity of the cause (cause.h), then by signature. Within one signature, failures
  // with a shrunk mesh come first, then failures with a shorter mesh; the rest is ordered by id.
  std::vector<FailureRecord> failures;
  EvidenceFacts evidence;
  std::string library;     // path of the plug-in's library as given to the run; empty: not known
  std::string begin_time;  // in UTC; if there are several runs, the earliest; empty: not known
  // SHA-256 over all rows, without times and paths. Two runs of the same campaign under the same
  // seed have the same digest. If several runs are judged together: SHA-256 over their digests.
  std::string rows;

  // Returns whether the runs together are a whole campaign: one run does the whole plan, or N runs
  // of shares 1/N have seeds with all N remainders modulo N. With other seeds two runs would judge
  // the same indices (trial_index), and a check of every 16th index, for example, might never be
  // made. A part of a campaign has to pass fewer checks; for example, it needs no bounds.
  bool is_whole() const;
  // Returns how many of n items have to be done, summed over all runs.
  std::uint64_t shares_of(std::uint64_t n) const;
  // Return the number of cases that all runs together have to judge: in this stratum, or in all
  // strata.
  std::uint64_t quota(const StratumPlan& stratum) const;
  std::uint64_t quota() const;
  // Returns whether all trials of a stratum took place, and in each of them the contract left the
  // case out, or the detector refused the case as beyond its capacity.
  bool is_left_out(const StratumPlan& stratum) const;
  // Returns the tally of a family; an empty tally if no trial of the family was judged.
  const StratumTally& tally_of(const StratumPlan& stratum) const;
  // Returns one failure of each signature (example_of), the least odd cause first (cause.h).
  std::vector<const FailureRecord*> kinds() const;
  std::uint64_t met_count(const FailureRecord& failure) const;
  // Returns a stored failure of this signature; null if there is none. A failure that is not flaky
  // is preferred, then a failure that does not come from the corpus.
  const FailureRecord* example_of(const std::string& signature) const;
  // Returns the outcomes of one configuration in one stratum.
  StratumTally::Outcomes outcomes_of(const StratumPlan& stratum, std::size_t configuration) const;
  // Returns whether the gate `harness` judges how often the premises of laws held: the detector is
  // built in, the plan has laws, and all trials of a whole campaign took place.
  bool laws_are_judged() const;
  // Returns whether the same command, given again, would do further work, because the run was
  // killed or its time ended.
  bool has_more_to_do() const;
  // Return the numbers of planted faults that were tried, that were found, and that were found by
  // random cases. finds() - found_at_random() faults were found only by their curated cases.
  std::uint64_t faults() const, finds() const, found_at_random() const;
};

// Returns the findings of all stores in the folder, whose runs are judged together. No other
// function makes findings. O(trials).
//
// Fails if Store::read fails, if the folder holds no run, if two runs have different plans, builds
// or detectors, if two runs have the same seed, or if a store holds a trial that is not in the plan
// of its run.
Expected<RunFindings> read_findings(const std::filesystem::path& folder);

// The functions below compute the bounds that the trials of a campaign support.

// Returns the configurations that run in a stratum, in the order of TrialRecord::outcomes. A
// configuration with the name of a family of questions (question_families) runs only in the stratum
// of that name, and no other configuration runs there.
std::vector<BoundDetector::Configuration> configurations_in(const BoundDetector& detector,
                                                            std::string_view family);

// Returns the number of bounds: for each stratum the number of claims of its configurations. Strata
// of large sizes (size_families) do not count here, because each bound of such a stratum is stated
// separately. A trial that breaks any claim of a configuration counts against the bound of that
// configuration, so one bound would suffice for all claims of the configuration. To count every
// claim only widens the bounds.
std::uint64_t number_of_bounds(const BoundRun& run);

// Returns the risk of each bound, such that all of them hold together with family_confidence.
double risk_of_each(const BoundRun& run);

// Returns the risk of each bound of a stratum: risk_of_each, or 1 - family_confidence for a stratum
// of large sizes, because each bound of such a stratum is stated separately.
double risk_in(const StratumPlan& stratum, const BoundRun& run);

// Returns the bound on the share of cases in which one configuration does not hold.
double bound_of(const StratumTally::Outcomes& outcomes, const StratumPlan& stratum,
                const BoundRun& run);

// Returns whether the gate `bounds` accepts a configuration in a stratum: its bound is not above
// the wanted bound, or, if no bound is wanted, every trial has a verdict. The gate also accepts a
// stratum from which the contract takes no case, a stratum of large sizes without a wanted bound,
// and a stratum with a wanted bound in a part of a campaign.
bool is_met(const RunFindings& findings, const StratumPlan& stratum, std::size_t configuration);

// Returns whether all configurations have the same outcomes in a stratum, so that one row suffices.
bool configurations_agree(const RunFindings& findings, const StratumPlan& stratum);

}  // namespace assay::properties
