// All that the stores of a folder say of one campaign. read_findings reads it and gates.h judges
// it; every text, file and page only presents findings and gates.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
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

// One run of those that are judged together.
struct RunPart {
  std::uint64_t seed = 1, shares = 1;  // as of CampaignRequest
  std::string rows;                    // its digest (RunFindings::rows)
};

struct RunFindings {
  std::filesystem::path folder;
  BoundRun run;                  // the first one, if several are judged together
  std::vector<StoreFile> files;  // by name
  std::vector<RunPart> parts;    // by seed; one of a run that is judged by itself
  Tally tally;
  Counts times_met;                 // how often each signature of a failure was met
  std::uint64_t claims_broken = 0;  // how often one was met that breaks no law
  // Ordered by signature; within one signature the shrunk ones first, then the shorter, then by
  // id.
  std::vector<FailureRecord> failures;
  EvidenceFacts evidence;
  std::string library;     // the plug-in's library as the run was told; empty: not known
  std::string begin_time;  // when, in UTC; of several stores the earliest; empty: not known
  // SHA-256 over all rows but times and paths. It is the same for the same campaign, however long
  // that took and wherever it was kept. Of several runs: over their digests.
  std::string rows;

  // Whether the runs together reach what the plan asks of a whole campaign: one of them does it
  // all, or N shares 1/N have seeds that leave each remainder of division by N. Under other seeds
  // they would judge the same indices (trial_index), and what is asked of every 16th index, say,
  // might be asked of none. What is wanted of the whole alone, such as a bound, is not asked of
  // less.
  bool is_whole() const;
  // What the runs have to do together of n.
  std::uint64_t shares_of(std::uint64_t n) const;
  // The number of cases that the runs have to judge together, of one family and of all.
  std::uint64_t quota(const StratumPlan& stratum) const;
  std::uint64_t quota() const;
  // Whether the contract left out every case of a family, once all of them were drawn, or the
  // detector refused it as beyond its capacity.
  bool is_left_out(const StratumPlan& stratum) const;
  // The tally of a family; an empty one if no trial of it was judged.
  const StratumTally& tally_of(const StratumPlan& stratum) const;
  // One failure of each signature (example_of), the least odd cause first (cause.h).
  std::vector<const FailureRecord*> kinds() const;
  std::uint64_t met_count(const FailureRecord& failure) const;
  // A stored failure of this signature, if possible one of a trial rather than of the corpus; null
  // if there is none.
  const FailureRecord* example_of(const std::string& signature) const;
  // The outcomes of one configuration in one stratum.
  StratumTally::Outcomes outcomes_of(const StratumPlan& stratum, std::size_t configuration) const;
  // Whether it can be judged if the laws were met often enough. That is so for the built-in
  // detector once all trials of a whole campaign took place.
  bool laws_are_judged() const;
  // Whether the same command would add something, because the run was killed or ended by its time.
  bool has_more_to_do() const;
  // How many planted faults were tried, how many were found, and how many of these by random cases.
  // The others were found by their curated case alone.
  std::uint64_t faults() const, finds() const, found_at_random() const;
};

// Reads the stores of a folder into findings. This is done here and nowhere else.

// Reads all stores of the folder, which are judged together. O(trials).
//
// Refuses, besides what Store::read refuses: a folder without a run; two runs of different plans,
// builds or detectors; a seed that is there twice; a trial that its run does not plan.
Expected<RunFindings> read_findings(const std::filesystem::path& folder);

// The bounds that the trials of a campaign support, all of them together.

// The configurations in which the detector is asked in a stratum, in the order of the outcomes of
// its trials. A configuration that bears the name of a family of questions (question_families) is
// asked in the stratum of that name, and no other is asked there.
std::vector<BoundDetector::Configuration> configurations_in(const BoundDetector& detector,
                                                            std::string_view family);

// The number of bounds: strata times the claims of their configurations. Strata of large sizes
// (size_families) are not among them: each of their bounds is stated alone. A trial that breaks any
// claim of a configuration counts against that configuration's bound, so one bound holds for all
// of its claims. Each claim is counted all the same, which only widens the bounds.
std::uint64_t number_of_bounds(const BoundRun& run);

// The risk of each bound, so that all of them hold together with family_confidence.
double risk_of_each(const BoundRun& run);

// The risk of the bound of a stratum: that of each, or family_confidence for itself alone.
double risk_in(const StratumPlan& stratum, const BoundRun& run);

// The bound on the share of cases on which one configuration does not hold.
double bound_of(const StratumTally::Outcomes& outcomes, const StratumPlan& stratum,
                const BoundRun& run);

// Whether the gate bounds has nothing to say against a configuration in a stratum: its bound is not
// above the one that is wanted, or, if none is wanted, every trial has a verdict. Nothing is asked
// of a family of which the contract takes no case, nor of one of large sizes without a wanted
// bound; no bound is asked of less than a whole campaign.
bool is_met(const RunFindings& findings, const StratumPlan& stratum, std::size_t configuration);

// Whether all configurations came to the same outcomes in a stratum, so that one row tells them.
bool configurations_agree(const RunFindings& findings, const StratumPlan& stratum);

}  // namespace assay::properties
