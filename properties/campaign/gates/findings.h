// The findings of one campaign: all that the stores of a folder say about it. read_findings reads
// them and gates.h judges them; every text, file and page only presents findings and gates.
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
  std::string name;    // without its folder
  std::string sha256;  // of its bytes
};
ASSAY_FIELDS(StoreFile, name, sha256)

// One of the runs that are judged together.
struct RunPart {
  std::uint64_t seed = 1, shares = 1;  // as in CampaignRequest
  std::string rows;                    // the run's digest (RunFindings::rows)
};

struct RunFindings {
  std::filesystem::path folder;
  BoundRun run;                  // the first one, if several are judged together
  std::vector<StoreFile> files;  // by name
  std::vector<RunPart> parts;    // by seed; a single one if one run is judged by itself
  Tally tally;
  Counts times_met;                 // how often each signature of a failure was met
  std::uint64_t claims_broken = 0;  // how often a failure that breaks no law was met
  // Ordered by signature; within one signature shrunk failures first, then shorter ones, then by
  // id.
  std::vector<FailureRecord> failures;
  EvidenceFacts evidence;
  std::string library;     // path of the plug-in's library as given to the run; empty: not known
  std::string begin_time;  // in UTC; the earliest of several stores; empty: not known
  // SHA-256 over all rows but times and paths. It is the same for the same campaign, however long
  // the campaign took and wherever it was stored. For several runs: SHA-256 over their digests.
  std::string rows;

  // Returns whether the runs together are a whole campaign: one run does all of it, or N runs of
  // shares 1/N have seeds with all N remainders modulo N. Under other seeds two runs would judge
  // the same indices (trial_index), and a check of every 16th index, say, might never be made.
  // Some demands, such as bounds, are made only of a whole campaign.
  bool is_whole() const;
  // Returns how many of n items the runs have to do together.
  std::uint64_t shares_of(std::uint64_t n) const;
  // Return the number of cases that the runs have to judge together, in one family and in all.
  std::uint64_t quota(const StratumPlan& stratum) const;
  std::uint64_t quota() const;
  // Returns whether all cases of a family were drawn, and each was left out by the contract or
  // refused by the detector as beyond its capacity.
  bool is_left_out(const StratumPlan& stratum) const;
  // Returns the tally of a family; an empty one if no trial of the family was judged.
  const StratumTally& tally_of(const StratumPlan& stratum) const;
  // Returns one failure of each signature (example_of), the least odd cause first (cause.h).
  std::vector<const FailureRecord*> kinds() const;
  std::uint64_t met_count(const FailureRecord& failure) const;
  // Returns a stored failure of this signature, if possible one of a trial rather than of the
  // corpus; null if there is none.
  const FailureRecord* example_of(const std::string& signature) const;
  // Returns the outcomes of one configuration in one stratum.
  StratumTally::Outcomes outcomes_of(const StratumPlan& stratum, std::size_t configuration) const;
  // Returns whether the run shows if laws were met often enough. It does for the built-in detector,
  // once all trials of a whole campaign took place.
  bool laws_are_judged() const;
  // Returns whether the same command would add something: the run was killed or its time ended.
  bool has_more_to_do() const;
  // Return how many planted faults were tried, how many were found, and how many of these by random
  // cases. The others were found by their curated case alone.
  std::uint64_t faults() const, finds() const, found_at_random() const;
};

// Reads the stores of a folder into findings. This is done here and nowhere else.

// Reads all stores of the folder, whose runs are judged together. O(trials).
//
// Refuses, besides what Store::read refuses: a folder without a run; two runs of different plans,
// builds or detectors; two runs with the same seed; a trial that its run does not plan.
Expected<RunFindings> read_findings(const std::filesystem::path& folder);

// States the bounds that the trials of a campaign support, all of them together.

// Returns the configurations in which the detector is asked in a stratum, in the order of its
// trials' outcomes. A configuration with the name of a family of questions (question_families) is
// asked only in the stratum of that name, and no other configuration is asked there.
std::vector<BoundDetector::Configuration> configurations_in(const BoundDetector& detector,
                                                            std::string_view family);

// Returns the number of bounds: strata times the claims of their configurations. Strata of large
// sizes (size_families) are not among them: each of their bounds is stated alone. A trial that
// breaks any claim of a configuration counts against that configuration's bound, so one bound holds
// for all of its claims. Counting every claim nevertheless only widens the bounds.
std::uint64_t number_of_bounds(const BoundRun& run);

// Returns the risk of each bound, such that all of them hold together with family_confidence.
double risk_of_each(const BoundRun& run);

// Returns the risk of a stratum's bound: risk_of_each, or 1 - family_confidence if it stands alone.
double risk_in(const StratumPlan& stratum, const BoundRun& run);

// Returns the bound on the share of cases in which one configuration does not hold.
double bound_of(const StratumTally::Outcomes& outcomes, const StratumPlan& stratum,
                const BoundRun& run);

// Returns whether the gate `bounds` accepts a configuration in a stratum: its bound is not above
// the wanted one, or, if none is wanted, every trial has a verdict. Nothing is asked of a family
// from which the contract takes no case, nor of a family of large sizes without a wanted bound. No
// bound is asked of less than a whole campaign.
bool is_met(const RunFindings& findings, const StratumPlan& stratum, std::size_t configuration);

// Returns whether all configurations have the same outcomes in a stratum, so that one row suffices.
bool configurations_agree(const RunFindings& findings, const StratumPlan& stratum);

}  // namespace assay::properties
