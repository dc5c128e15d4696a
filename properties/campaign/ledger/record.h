// The records that a campaign stores of each trial and of each failure; and their rows.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "properties/campaign/ledger/database.h"
#include "properties/fields.h"
#include "properties/judging/agreement.h"
#include "properties/judging/step_measures.h"

namespace assay::properties {

// How often something with a name was met.
using Counts = std::map<std::string, std::uint64_t, std::less<>>;

// How often a law was met (LawTally, law.h).
struct LawCount {
  std::uint64_t premise = 0, close = 0, broken = 0;
  // By the word for the culling, its part of `premise`; for a law to be met under several cullings.
  Counts by_culling;
  // Only for a plug-in: steps whose answers differ in two forms of a case, as its claims allow.
  std::uint64_t differs = 0;
  static constexpr bool adds_up = true;
  friend bool operator==(const LawCount&, const LawCount&) = default;
};
ASSAY_FIELDS(LawCount, premise, close, broken, differs, by_culling)

// The number of contacts, and of contacts that are the first of their step.
struct SetPairCount {
  std::uint64_t contacts = 0, first_contacts = 0;
  static constexpr bool adds_up = true;
  friend bool operator==(const SetPairCount&, const SetPairCount&) = default;
};
ASSAY_FIELDS(SetPairCount, contacts, first_contacts)

// The extremes of one case or of many: the largest value of each member.
struct Extremes {
  std::uint64_t steps_in_a_row = 0;  // from a new start to the step before the next one
  std::uint64_t valence = 0;         // triangles at a vertex
  std::uint64_t bodies = 0;          // in a relation that names bodies
  std::uint64_t components = 0;      // triangles connected through shared vertices
  std::uint64_t pairs = 0;           // in contact in one step, by the oracle
  std::uint64_t triangles = 0;
  void include(const Extremes& other);  // the larger value of each stays
  friend bool operator==(const Extremes&, const Extremes&) = default;
};
ASSAY_FIELDS(Extremes, steps_in_a_row, valence, bodies, components, pairs, triangles)
inline void add_to(Extremes& sum, const Extremes& more) { sum.include(more); }

// The counts of a trial besides its outcomes. Member by member they add up to the counts of many.
struct TrialCounts {
  Counts tags;  // cases that have the tag
  // The keys name the view sets of the two triangles in contact, and the law.
  std::map<std::string, SetPairCount, std::less<>> set_pairs;
  std::map<std::string, LawCount, std::less<>> laws;
  StepMeasures measures;  // most of them only for a plug-in
  Extremes extremes{};    // of a mesh that was judged; over many, the largest
  static constexpr bool adds_up = true;
  friend bool operator==(const TrialCounts&, const TrialCounts&) = default;
};
ASSAY_FIELDS(TrialCounts, tags, set_pairs, laws, measures, extremes)

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
// The letter of a configuration that was not run, such as Culling::none on large meshes.
inline constexpr char not_run = '-';

// The source of the cases that a campaign judges.
enum class Source : std::uint8_t { trial, corpus, own, repeated, search, self_test };

// All facts about a source, for the code that names its cases, adds up their results or shows them.
struct SourceRow {
  Source value;
  const char* name;
  Source counts_as;    // itself, or the source that it is a part of
  bool is_drawn;       // its cases depend on the seed, so those of runs under other seeds add up
  const char* prefix;  // begins the ids of its failures, and no id of a trial
  // Texts: the first two say, on the terminal and in a summary, where a kind of failure was met
  // that no trial shows; the last names the count behind the verdict.
  const char *contact_text = "", *met_in_summary = "", *defects = "";
  // The section of a certificate that lists the source's inputs, if any; and the members of
  // JudgedSource shown there. "queries=cases" shows `cases` under the name `queries`.
  const char *section = "", *shown_text = "";
};
constexpr auto names_of(Source) {
  using enum Source;
  constexpr const char* in_corpus = "met in the corpus alone";
  return std::to_array<SourceRow>(
      {{trial, "trial", trial, true, ""},
       {corpus, "corpus", corpus, false, "corpus/", in_corpus, in_corpus, "", "corpus",
        "cases collisions configuration defects extremes failed input left_out open pairs steps "
        "triangles_in_contact"},
       {own, "own cases", corpus, false, "own/", in_corpus, in_corpus},
       {repeated, "repeated", repeated, true, "repeated/", "met on a large mesh or a long sequence",
        in_corpus, "wrong steps of larger meshes", "repeated",
        "broken configuration extremes input judged runs steps threads triangles what"},
       {search, "search", search, true, "search/", "found by the search",
        "found by the search alone", "cases of the search with a defect", "search"},
       {self_test, "self-test", self_test, false, "", "", "", "", "",
        "family=input complete contacts=collisions contradictions=defects open=undecided "
        "queries=cases"}});
}

// A defect, with its mesh if that is kept. `mesh` and `smallest` are case files (assay-case/1) as
// text.
struct FailureRecord {
  Source source = Source::trial;
  std::string case_id, configuration;
  std::string law{};  // the broken law; empty: only a claim is broken
  // The word of the broken claim; how it is broken and at which stage; the feature and cause of the
  // contact. Empty if only a law is broken.
  std::string claim{}, kind{}, contact{};
  std::string explanation{};
  std::string mesh{};                  // empty: the failure was met, its mesh is not stored
  std::string smallest{};              // empty: the mesh was not shrunk
  std::string smallest_explanation{};  // of the mesh `smallest`; empty: same as `explanation`
  bool flaky = false;                  // the case, run alone in a new process, does not fail so
  std::string printed{};               // what the plug-in printed; may differ between runs

  // Return the texts for people. The id begins with a prefix of the source, such as "corpus/" in
  // "corpus/NAME"; no trial's id does, because the name of a campaign has no '/'. The other two
  // texts name a broken law, "law L3_..." and "view-point, law L3_...", because one case may break
  // both a law and a claim in the same configuration.
  std::string id() const, signature() const, shown_configuration() const;
  std::string rule() const;  // law and claim, with which the signature begins
  // Returns the explanation of the smallest mesh, if there is one. For a flaky failure, which is
  // not shrunk, the text says what flaky means.
  std::string shown_explanation() const;
  // Returns "met 3 times"; for a kind that no trial has shown, where it was found.
  std::string met_text(std::uint64_t trials) const;
  bool is_of_corpus() const { return row_of(source).counts_as == Source::corpus; }
};

// A text behind the explanation of a failure that its own case does not show.
inline constexpr const char* needs_what_came_before =
    "; its case alone gives another result: the failure may need earlier work of the process, and "
    "a replay may hold";

// Returns the description in a failure's case file: "all-pairs: missing pair, edge-edge; triangles
// 0 and 1 meet at t = 0.5".
std::string about_text(const std::string& signature, const std::string& explanation);

// Turn records into rows and back; reading throws StoreProblem if no run stores such a row.
// `met_row` says that a trial failed in this way. It is stored for every failure, while only a few
// meshes are stored.
Row to_row(const TrialRecord& record);
Row to_row(const FailureRecord& failure);
Row met_row(const FailureRecord& failure);
TrialRecord trial_of(const Row& row);
FailureRecord failure_of(const Row& row);

}  // namespace assay::properties
