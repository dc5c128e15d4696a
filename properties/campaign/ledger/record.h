// What a campaign keeps of each trial, and of each failure of a trial; and their rows.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

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
  // The premise by the word for the culling, for a law that has to be met under several of them.
  Counts by_culling;
  // Of a plug-in: steps whose answers differ in two forms of a case, which its claims allow.
  std::uint64_t differs = 0;
  static constexpr bool adds_up = true;
  friend bool operator==(const LawCount&, const LawCount&) = default;
};
ASSAY_FIELDS(LawCount, premise, close, broken, differs, by_culling)

// Contacts, and those of them that are the first of their step.
struct SetPairCount {
  std::uint64_t contacts = 0, first_contacts = 0;
  static constexpr bool adds_up = true;
  friend bool operator==(const SetPairCount&, const SetPairCount&) = default;
};
ASSAY_FIELDS(SetPairCount, contacts, first_contacts)

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
inline void add_to(Extremes& sum, const Extremes& more) { sum.include(more); }

// What is counted of a trial besides its outcomes. The same members add up to what is counted of
// many.
struct TrialCounts {
  Counts tags;  // cases that have the tag
  // By the view sets of the two triangles in contact, and by the names of laws.
  std::map<std::string, SetPairCount, std::less<>> set_pairs;
  std::map<std::string, LawCount, std::less<>> laws;
  StepMeasures measures;  // most of them only of a plug-in
  Extremes extremes{};    // of a mesh that was judged; of many the largest of each
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
// Of a configuration that was not run: culling none on large meshes.
inline constexpr char not_run = '-';

// Where the cases come from that a campaign judges.
enum class Source : std::uint8_t { trial, corpus, own, repeated, search, self_test };

// All that there is to know of a source: who names its cases, adds up what they came to or shows
// it reads it here.
struct SourceRow {
  Source value;
  const char* name;
  Source counts_as;    // itself, or the source of which it is a part
  bool is_drawn;       // by the seed: runs under other seeds have other cases, which add up
  const char* prefix;  // of the ids of its failures; no trial's id begins so
  // Where a kind of failure was met that no trial has shown, and the same in a summary; and what is
  // counted behind the verdict.
  const char *contact_text = "", *met_in_summary = "", *defects = "";
  // Its section of a certificate, where that lists its inputs, and what is shown of each: members
  // of JudgedSource, with another name in front where they have one ("queries=cases").
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
  std::string law{};  // that is broken; empty: a claim alone is
  // What fails: the word of the claim, how it is broken and at which stage, and the feature and
  // cause of the contact. Empty if a law alone is broken.
  std::string claim{}, kind{}, contact{};
  std::string explanation{};
  std::string mesh{};                  // empty: it was met, and is not kept
  std::string smallest{};              // empty: the mesh was not shrunk
  std::string smallest_explanation{};  // of `smallest`; empty: the explanation is of both
  bool flaky = false;                  // its case alone, in a new process, comes to something else
  std::string printed{};               // by the plug-in as it failed; may differ between runs

  // As people see them. The id begins with the prefix of what its source counts as, "corpus/NAME";
  // no trial's id begins so, because the name of a campaign has no '/'. A broken law stands in both
  // others, "law L3_..." and "view-point, law L3_...", because one case may break both a law and a
  // claim in the same configuration.
  std::string id() const, signature() const, shown_configuration() const;
  std::string rule() const;  // law and claim, with which the signature begins
  // The explanation of the smallest mesh, if there is one. Of a flaky failure, which is not shrunk,
  // it says what that means.
  std::string shown_explanation() const;
  // "met 3 times"; of a kind that no trial has shown, where it was found.
  std::string met_text(std::uint64_t trials) const;
  bool is_of_corpus() const { return row_of(source).counts_as == Source::corpus; }
};

// What is said behind the explanation of a failure that its own case does not show.
inline constexpr const char* needs_what_came_before =
    "; asked again by itself, it comes to something else: what fails may need what the process did "
    "before, and a replay may hold";

// What the case file of a failure says of itself: "all-pairs: missing pair, edge-edge; triangles 0
// and 1 meet at t = 0.5".
std::string about_text(const std::string& signature, const std::string& explanation);

// The rows of these, and what a row says; the latter throws StoreProblem if no run stores such a
// row. `met_row` says that a trial failed so. It is stored for every failure, while the mesh is
// kept for a few of them only.
Row to_row(const TrialRecord& record);
Row to_row(const FailureRecord& failure);
Row met_row(const FailureRecord& failure);
TrialRecord trial_of(const Row& row);
FailureRecord failure_of(const Row& row);

}  // namespace assay::properties
