// The records that a campaign stores of each trial and of each failure, and the functions that turn
// records into rows and back.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "properties/campaign/ledger/database.h"
#include "properties/fields.h"
#include "properties/judging/agreement.h"
#include "properties/judging/step_measures.h"

namespace assay::properties {

// The number of things of each name.
using Counts = std::map<std::string, std::uint64_t, std::less<>>;

// Counts of steps on which a law was checked (LawTally, law.h).
struct LawCount {
  std::uint64_t premise = 0, close = 0, broken = 0;
  // The part of `premise` under each culling, by the word for the culling. Empty for a law whose
  // premise may hold under any culling.
  Counts by_culling;
  // Only for a plug-in: steps whose answers differ between two forms of a case.
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
  std::uint64_t steps_in_a_row = 0;  // from a new start to the step before the next new start
  std::uint64_t valence = 0;         // triangles at a vertex
  std::uint64_t bodies = 0;          // bodies of a relation that names bodies
  std::uint64_t components = 0;      // sets of triangles connected through shared vertices
  std::uint64_t pairs = 0;           // pairs in contact in one step, by the oracle
  std::uint64_t triangles = 0;
  void include(const Extremes& other);  // each member becomes the larger of the two values
  friend bool operator==(const Extremes&, const Extremes&) = default;
};
ASSAY_FIELDS(Extremes, steps_in_a_row, valence, bodies, components, pairs, triangles)
inline void add_to(Extremes& sum, const Extremes& more) { sum.include(more); }

// The counts of a trial besides its outcomes. Member by member, the counts of single trials add up
// to the counts of many trials.
struct TrialCounts {
  Counts tags;  // cases that have the tag
  // By the names of the view sets of the two triangles in contact.
  std::map<std::string, SetPairCount, std::less<>> set_pairs;
  std::map<std::string, LawCount, std::less<>> laws;  // by the name of the law
  StepMeasures measures;                              // most of them only for a plug-in
  Extremes extremes{};  // of the judged mesh; over many trials, the largest value of each member
  static constexpr bool adds_up = true;
  friend bool operator==(const TrialCounts&, const TrialCounts&) = default;
};
ASSAY_FIELDS(TrialCounts, tags, set_pairs, laws, measures, extremes)

struct TrialRecord {
  std::string id;  // campaign:seed:family:index
  std::string family;
  std::uint64_t index = 0;
  // One letter for each configuration: H(olds) D(efect) U(ndecided) E(rror) R(efused: capacity), or
  // not_run.
  std::string outcomes;
  std::uint64_t triangles = 0, steps = 0, collisions = 0, pairs = 0;
  std::uint64_t oracle_us = 0, detector_us = 0;
  TrialCounts counts;
  std::uint64_t mesh = 0;  // hash of the case's triangles and frames: equal cases, equal hashes
  // How often a worker was killed from outside while it ran this trial, which was then run again.
  std::uint64_t disturbed = 0;
  // The most processor time that one configuration took, even if the time limit ended its run.
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
  bool is_drawn;       // its cases depend on the seed, so results under different seeds add up
  const char* prefix;  // the ids of its failures begin with this text; no id of a trial does
  // Some kinds of failure are shown by no trial. contact_text (on the terminal) and met_in_summary
  // (in a summary) say where such a kind was found. `defects` is the label in front of the number
  // of defects, in the line that states a verdict.
  const char *contact_text = "", *met_in_summary = "", *defects = "";
  // section: the section of a certificate that lists the source's inputs, if any. shown_text: the
  // members of JudgedSource in that section; "queries=cases" shows `cases` under the name
  // `queries`.
  const char *section = "", *shown_text = "";
};
constexpr auto names_of(Source) {
  using enum Source;
  constexpr const char* in_corpus = "met only in the corpus";
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
        "found only by the search", "cases of the search with a defect", "search"},
       {self_test, "self-test", self_test, false, "", "", "", "", "",
        "family=input complete contacts=collisions contradictions=defects open=undecided "
        "queries=cases"}});
}

// A defect, with its mesh if the mesh is stored. `mesh` and `smallest` are case files
// (assay-case/1) as text.
struct FailureRecord {
  Source source = Source::trial;
  std::string case_id, configuration;
  std::string law{};  // the broken law; empty: only a claim is broken
  // The word of the broken claim; how it is broken and at which stage; the feature and cause of the
  // contact. Empty if only a law is broken.
  std::string claim{}, kind{}, contact{};
  std::string explanation{};
  std::string mesh{};                  // empty: the mesh of this failure is not stored
  std::string smallest{};              // empty: the mesh was not shrunk
  std::string smallest_explanation{};  // of the mesh `smallest`; empty: same as `explanation`
  bool flaky = false;     // the case does not fail in this way if it is run alone in a new process
  std::string printed{};  // the output of the plug-in; may differ between runs

  // Return the texts for people. The id begins with SourceRow::prefix, as in "corpus/NAME"; the id
  // of a trial has no '/'. If a law is broken, signature and configuration name the law ("law
  // L3_...", "view-point, law L3_..."), because one case can break both a law and a claim in the
  // same configuration.
  std::string id() const, signature() const, shown_configuration() const;
  std::string rule() const;  // the broken law and claim: the beginning of the signature
  // Returns the explanation of the smallest mesh, if there is one. For a flaky failure, which is
  // not shrunk, the text says what flaky means.
  std::string shown_explanation() const;
  // Returns "met 3 times", or, if no trial shows the failure, where the failure was found.
  std::string met_text(std::uint64_t trials) const;
  bool is_of_corpus() const { return row_of(source).counts_as == Source::corpus; }
};

// The end of the explanation of a flaky failure.
inline constexpr const char* needs_what_came_before =
    "; its case alone gives another result: the failure may need earlier work of the process, and "
    "a replay may hold";

// Returns the description in a failure's case file: "all-pairs: missing pair, edge-edge; triangles
// 0 and 1 meet at t = 0.5".
std::string about_text(const std::string& signature, const std::string& explanation);

// Turn records into rows and back. trial_of and failure_of throw StoreProblem if no run stores such
// a row. met_row returns the row that counts a failure. A trial stores such a row for each of its
// failures, but it stores the meshes of only a few.
Row to_row(const TrialRecord& record);
Row to_row(const FailureRecord& failure);
Row met_row(const FailureRecord& failure);
TrialRecord trial_of(const Row& row);
FailureRecord failure_of(const Row& row);

}  // namespace assay::properties
