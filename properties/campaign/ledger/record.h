// What a campaign keeps of each trial, and of each failure of a trial; and their rows.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/step_measures.h"
#include "properties/fields.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// How often something with a name was met.
using Counts = std::map<std::string, std::uint64_t, std::less<>>;

// How often a law was met (LawTally, law.h).
struct LawCount {
  std::uint64_t premise = 0, close = 0, broken = 0;
  // The premise by the word for the culling, for a law that has to be met under several of them.
  Counts by_culling;
  // Of a plug-in: steps whose answers differ in two forms of a case, which its claims allow.
  std::uint64_t differs = 0;
  LawCount& operator+=(const LawCount& other);
  friend bool operator==(const LawCount&, const LawCount&) = default;
};

// Contacts, and those of them that are the first of their step.
struct SetPairCount {
  std::uint64_t contacts = 0, first_contacts = 0;
  SetPairCount& operator+=(const SetPairCount& other);
  friend bool operator==(const SetPairCount&, const SetPairCount&) = default;
};

// How far cases go, of one case or of many: the largest of each.
struct Extremes {
  std::uint64_t steps_in_a_row = 0;  // from a new start to the step before the next one
  std::uint64_t valence = 0;         // triangles at a vertex
  std::uint64_t bodies = 0;          // of a relation that names some
  std::uint64_t components = 0;      // triangles connected through shared vertices
  std::uint64_t pairs = 0;           // in contact in one step, by the oracle
  std::uint64_t triangles = 0;
  void include(const Extremes& other);  // the larger of each stays
  friend bool operator==(const Extremes&, const Extremes&) = default;
};
ASSAY_FIELDS(Extremes, steps_in_a_row, valence, bodies, components, pairs, triangles)

// What is counted of a trial besides its outcomes. The same members add up to what is counted of
// many.
struct TrialCounts {
  Counts tags;  // cases that have the tag
  // By the view sets of the two triangles in contact, and by the names of laws.
  std::map<std::string, SetPairCount, std::less<>> set_pairs;
  std::map<std::string, LawCount, std::less<>> laws;
  StepMeasures measures;  // most of them only of a plug-in
  Extremes extremes{};    // of a mesh that was judged; of many the largest of each
  TrialCounts& operator+=(const TrialCounts& other);
  friend bool operator==(const TrialCounts&, const TrialCounts&) = default;
};

struct TrialRecord {
  std::string id;  // campaign:seed:family:index
  std::string family;
  std::uint64_t index = 0;
  // One letter a configuration: H(olds) D(efect) U(ndecided) E(rror) R(efused: capacity), or
  // not_run.
  std::string outcomes;
  std::uint64_t triangles = 0, steps = 0, collisions = 0, pairs = 0;
  std::uint64_t oracle_us = 0, detector_us = 0;
  TrialCounts counts;
  std::uint64_t mesh = 0;  // hash of the case's triangles and frames: equal cases, equal hashes
  // How often a worker was killed from outside while it ran this trial, which was then run again.
  std::uint64_t disturbed = 0;
  // The most processor time that one configuration took, whether its limit ended it or not.
  std::uint64_t slowest_us = 0;
  bool has(Outcome outcome) const;  // some configuration has this outcome
  bool is_judged() const;           // some configuration holds or has a defect
};

char letter_of(Outcome outcome);
// Of a configuration that was not run: culling none on large meshes.
inline constexpr char not_run = '-';

// A defect with its mesh. `mesh` and `smallest` are case files (assay-case/1) as text.
struct StoredFailure {
  std::string id;  // id of the trial
  std::string configuration, signature, explanation;
  std::string mesh;
  std::string smallest;      // empty: the mesh was not shrunk
  bool flaky = false;        // its case alone, in a new process, comes to something else
  std::string printed = {};  // by the plug-in as it failed; may differ between runs
};

// The signature of a broken law is "law L3_...", and its `configuration` is "view-point, law
// L3_...", because one case may break both a law and a claim in the same configuration.
inline constexpr std::string_view law_in_signature = "law ", law_in_configuration = ", law ";

// The id of a failure that the shipped corpus shows is this and the name of its case. No trial's
// id begins so: the name of a campaign has no '/'.
inline constexpr std::string_view corpus_in_id = "corpus/";

// The id of a failure that a large mesh shows, on which two runs differ, begins with this.
inline constexpr std::string_view repeated_in_id = "repeated/";

// And that of a failure that the search found (phases/phases.h).
inline constexpr std::string_view searched_in_id = "search/";
inline bool is_of_search(const StoredFailure& failure) {
  return failure.id.starts_with(searched_in_id);
}

// What is said behind the explanation of a failure that its own case does not show.
inline constexpr const char* needs_what_came_before =
    "; asked again by itself, it comes to something else: what fails may need what the process did "
    "before, and a replay may hold";

// `about_text` is what the case file of a failure says of itself: "all-pairs: missing pair,
// edge-edge; triangles 0 and 1 meet at t = 0.5". `shown_explanation` reads it back: it returns the
// part after the signature, from the smallest mesh if there is one. Of a flaky failure, which is
// not shrunk, it says what that means.
std::string about_text(const std::string& signature, const std::string& explanation);
std::string shown_explanation(const StoredFailure& failure);

// That a trial failed with this signature in this configuration. It is stored for every failure,
// while the mesh is kept for a few of them only.
struct MetFailure {
  std::string configuration, signature;  // as of StoredFailure
};

// The rows of these, and what a row says; the latter throws StoreProblem if no run stores such a
// row.
Row to_row(const TrialRecord& record);
Row to_row(const StoredFailure& failure);
Row to_row(const std::string& trial_id, const MetFailure& failure);
TrialRecord trial_of(const Row& row);
StoredFailure failure_of(const Row& row);
std::string met_signature_of(const Row& row);

}  // namespace assay::properties
