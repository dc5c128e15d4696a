// Adds up the trials of a campaign, and tells which laws were met too seldom or broken.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "properties/campaign/ledger/record.h"
#include "properties/laws/law.h"

namespace assay::properties {

// Sums over the trials of one family.
struct StratumTally {
  std::uint64_t trials = 0, steps = 0, collisions = 0, pairs = 0;
  std::uint64_t oracle_us = 0, detector_us = 0;
  std::uint64_t with_defect = 0, open = 0;  // trials with a configuration that has such an outcome
  std::uint64_t disturbed = 0;              // trials killed from outside, which ran again
  std::uint64_t discards = 0;               // trials for which the contract takes no case
  std::uint64_t refused = 0;                // trials that were refused as beyond the capacity
  std::set<std::uint64_t> meshes;           // hashes, one for each distinct case
  struct Outcomes {
    std::uint64_t holds = 0, defects = 0, undecided = 0, errors = 0;
    std::uint64_t refused = 0;  // not in trials(): nothing was judged
    std::uint64_t trials() const { return holds + defects + undecided + errors; }
    std::uint64_t open() const { return undecided + errors; }
    friend bool operator==(const Outcomes&, const Outcomes&) = default;
  };
  std::vector<Outcomes> by_configuration;
  StepMeasures measures;
  // The most triangles of a judged trial, of a trial with a contact that the contract does not
  // leave out, and of a trial that was run twice.
  std::uint64_t triangles = 0, triangles_in_contact = 0, triangles_repeated = 0;
  std::map<int, std::uint64_t> sizes;     // cases by floor(log2(triangles))
  std::map<int, std::uint64_t> contacts;  // cases by floor(log2(pairs)), -1: none
  void add(const TrialRecord& record);
};

struct Tally {
  // A trial is near its limit if a configuration took this processor time or more.
  std::uint64_t near_from_us = ~std::uint64_t{0};
  std::map<std::string, StratumTally, std::less<>> strata;  // by family
  TrialCounts counts;
  std::vector<TrialRecord> near_limit;  // in the order of adding; without counts
  // The trials that are undecided in some configuration, up to `most_undecided` of them; and the
  // slowest of the others, the slowest first. Both without their counts.
  std::vector<TrialRecord> undecided, slowest;
  static constexpr std::size_t most_undecided = 1000, most_slowest = 20;
  std::uint64_t disturbances = 0;
  void add(const TrialRecord& record);
  // Return numbers of trials over all strata: all trials; those with a case that the contract
  // takes; those with a defect in some configuration; those without a verdict in some
  // configuration; those that were disturbed.
  std::uint64_t trials() const, judged_trials() const, with_defect() const, open() const,
      disturbed() const;

 private:
  void note_slow(const TrialRecord& record);
};

// Adds the tally of a law. `culling` is its word on the command line.
void add_law(TrialCounts& counts, const Law& law, const LawTally& tally, std::string_view culling);

// Returns the counts of the laws of this build, in the order of laws(): of all laws, or, for a
// plug-in, of the laws about plug-ins. Empty for a plug-in in whose trials no law was met.
std::vector<std::pair<const Law*, LawCount>> laws_in(const TrialCounts& counts,
                                                     bool built_in = true);

// Returns the cullings under which a campaign has to meet the law, each with the number of times
// that the premise held; nothing if any culling will do.
std::vector<std::pair<std::string, std::uint64_t>> premises_by_culling(const LawCount& count,
                                                                       const Law& law);

// Returns why a law was met too seldom: its premise held less often than wanted, or was close in
// less than a quarter of the steps. Empty if it was met often enough, or if `wanted_premises` is 0.
std::string starved(const Law& law, const LawCount& count, std::uint64_t wanted_premises);
// Returns a line of `starved` for each law that was met too seldom, and one for each culling under
// which a law was met in less than a tenth of the steps wanted for all cullings together.
std::vector<std::string> starved_laws(const TrialCounts& counts, std::uint64_t wanted_premises);

// Returns how many laws were broken.
std::uint64_t broken_laws(const TrialCounts& counts);

}  // namespace assay::properties
