// What a campaign keeps of each trial, and the sums over trials.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "properties/judging/agreement.h"

namespace assay::properties {

// Named counts: laws, tags, blocks of set pairs (count_names.h).
using Counts = std::map<std::string, std::uint64_t, std::less<>>;

void add(Counts& sum, const Counts& more);
// Counts as text, "name=3;other=1", and back. REQUIRES names without ';'.
std::string counts_text(const Counts& counts);
Counts parse_counts(std::string_view text);

struct TrialRecord {
  std::string id;  // campaign:seed:family:index
  std::string family;
  std::uint64_t index = 0;
  std::string outcomes;  // one letter a configuration: H(olds) D(efect) U(ndecided) E(rror)
  std::uint64_t triangles = 0, steps = 0, collisions = 0, pairs = 0;
  std::uint64_t oracle_us = 0, detector_us = 0;
  Counts counts;
  std::uint64_t mesh = 0;  // hash of the case's triangles and frames: equal cases, equal hashes
  // How often a worker was killed from outside while it ran this trial, which was then run again.
  std::uint64_t disturbed = 0;
  // The most processor time that one configuration took, whether its limit ended it or not.
  std::uint64_t slowest_us = 0;
  bool has(Outcome outcome) const;  // some configuration has this outcome
};

char letter_of(Outcome outcome);

// Sums over the trials of one family.
struct StratumTally {
  std::uint64_t trials = 0, steps = 0, collisions = 0, pairs = 0;
  std::uint64_t oracle_us = 0, detector_us = 0;
  std::uint64_t with_defect = 0, open = 0;  // trials with a configuration that is so
  std::uint64_t disturbed = 0;              // trials killed from outside, which ran again
  std::uint64_t discards = 0;      // trials for which no case was drawn that the contract takes
  std::set<std::uint64_t> meshes;  // hashes: as many as there are distinct cases
  struct Outcomes {
    std::uint64_t holds = 0, defects = 0, undecided = 0, errors = 0;
    std::uint64_t trials() const { return holds + defects + undecided + errors; }
    std::uint64_t open() const { return undecided + errors; }
    friend bool operator==(const Outcomes&, const Outcomes&) = default;
  };
  std::vector<Outcomes> by_configuration;
  Counts measures;  // step_measures.h; most of them only of a plug-in
  // The most triangles of a trial that was judged, of one with a contact that the contract does
  // not leave out, and of one that was run twice.
  std::uint64_t triangles = 0, triangles_in_contact = 0, triangles_repeated = 0;
  std::map<int, std::uint64_t> sizes;     // cases by floor(log2(triangles))
  std::map<int, std::uint64_t> contacts;  // cases by floor(log2(pairs)), -1: none
  void add(const TrialRecord& record);
};

struct Tally {
  // A trial is near its limit if a configuration took at least this processor time.
  std::uint64_t near_from_us = ~std::uint64_t{0};
  std::map<std::string, StratumTally, std::less<>> strata;  // by family
  Counts counts;
  std::vector<TrialRecord> near_limit;  // in the order of adding; without counts
  // The trials that are undecided in some configuration, up to `most_undecided` of them; and of
  // the others the slowest, the slowest first. Both without their counts.
  std::vector<TrialRecord> undecided, slowest;
  static constexpr std::size_t most_undecided = 1000, most_slowest = 20;
  std::uint64_t disturbances = 0;
  void add(const TrialRecord& record);
  // Numbers of trials, over all strata: all; those with a case that the contract takes; those with
  // a defect, and those without a verdict, in some configuration; those that were disturbed.
  std::uint64_t trials() const, judged() const, with_defect() const, open() const,
      disturbed() const;

 private:
  void note_slow(const TrialRecord& record);
};

}  // namespace assay::properties
