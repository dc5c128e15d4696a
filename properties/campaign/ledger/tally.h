// Adds up the trials of a campaign, and tells which laws were broken or had too few premises.
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
  // with_defect: trials in which some configuration has a defect. open: trials in which some
  // configuration has no verdict.
  std::uint64_t with_defect = 0, open = 0;
  std::uint64_t disturbed = 0;     // trials that were killed from outside and ran again
  std::uint64_t discards = 0;      // trials for which the contract takes no case
  std::uint64_t refused = 0;       // trials that were refused as beyond the capacity
  std::set<std::uint64_t> meshes;  // hashes, one for each distinct case
  struct Outcomes {
    std::uint64_t holds = 0, defects = 0, undecided = 0, errors = 0;
    std::uint64_t refused = 0;  // not counted in trials(), because nothing was judged
    std::uint64_t trials() const { return holds + defects + undecided + errors; }
    std::uint64_t open() const { return undecided + errors; }
    friend bool operator==(const Outcomes&, const Outcomes&) = default;
  };
  std::vector<Outcomes> by_configuration;
  StepMeasures measures;
  // The greatest number of triangles: of all judged trials, of trials with a contact that the
  // contract does not leave out, and of trials that were run twice.
  std::uint64_t triangles = 0, triangles_in_contact = 0, triangles_repeated = 0;
  std::map<int, std::uint64_t> sizes;     // cases by floor(log2(triangles))
  std::map<int, std::uint64_t> contacts;  // cases by floor(log2(pairs)); -1: no pair
  void add(const TrialRecord& record);
};

struct Tally {
  // A trial is near its limit if a configuration took this processor time or more.
  std::uint64_t near_from_us = ~std::uint64_t{0};
  std::map<std::string, StratumTally, std::less<>> strata;  // by family
  TrialCounts counts;
  std::vector<TrialRecord> near_limit;  // in the order of add(); `counts` is empty
  // undecided: the first most_undecided trials that are undecided in some configuration. slowest:
  // the most_slowest slowest of the other trials, the slowest first. `counts` is empty in both.
  std::vector<TrialRecord> undecided, slowest;
  static constexpr std::size_t most_undecided = 1000, most_slowest = 20;
  std::uint64_t disturbances = 0;
  void add(const TrialRecord& record);
  // Return the number over all strata of: all trials; trials with a case that the contract takes
  // and the detector did not refuse; trials with a defect in some configuration; trials without a
  // verdict in some configuration; and trials that were disturbed.
  std::uint64_t trials() const, judged_trials() const, with_defect() const, open() const,
      disturbed() const;

 private:
  void note_slow(const TrialRecord& record);
};

// Adds the tally of a law to the counts. `culling` is the word for the culling under which the law
// was checked.
void add_law(TrialCounts& counts, const Law& law, const LawTally& tally, std::string_view culling);

// Returns each law of this build with its counts, in the order of laws(). For a plug-in (`built_in`
// is false) only the laws about plug-ins are listed, and none if no trial checked a law.
std::vector<std::pair<const Law*, LawCount>> laws_in(const TrialCounts& counts,
                                                     bool built_in = true);

// Returns the cullings under each of which the law's premise must hold, with the number of steps in
// which it held. Empty if the premise may hold under any culling.
std::vector<std::pair<std::string, std::uint64_t>> premises_by_culling(const LawCount& count,
                                                                       const Law& law);

// Returns why a law was tested too little: its premise held in fewer than `wanted_premises` steps,
// or was close in less than a quarter of the steps in which it held. Empty if the law was tested
// enough, or if `wanted_premises` is 0.
std::string starved(const Law& law, const LawCount& count, std::uint64_t wanted_premises);
// Returns a line of starved() for each law that was tested too little, and a line for each culling
// under which a law's premise held in less than a tenth of `wanted_premises`.
std::vector<std::string> starved_laws(const TrialCounts& counts, std::uint64_t wanted_premises);

// Returns how many laws were broken.
std::uint64_t broken_laws(const TrialCounts& counts);

}  // namespace assay::properties
