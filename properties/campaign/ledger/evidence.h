// Evidence that a run stores besides its trials: one struct for each kind of evidence, and the
// functions that turn evidence into rows of the ledger and back. A struct states its kind and can
// have key() and progress(), which become columns of the row. Its members become the fields of the
// row. A line of text has the name `what` in all rows.
//
// Two runs of one campaign have equal rows, except rows of a kind with `may_differ`: SpeedFigure
// and Issuance hold times and paths, and a time limit can end the proof of a World early.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/plan.h"
#include "properties/faults/fault.h"

namespace assay::properties {

// A planted fault that every run must find. It is tried through a worker process, in the same way
// as the detector under test.
struct Canary {
  static constexpr const char* kind = "canary";
  std::string fault;
  std::optional<std::uint64_t> found_after;  // cases until it was found; nothing: not found
  const std::string& key() const { return fault; }
};
ASSAY_FIELDS(Canary, fault, found_after)

// The problem that stopped the harness itself, after `trials` trials had been stored. `what` is
// empty if there was no problem.
struct HarnessProblem {
  static constexpr const char* kind = "problem";
  std::string what;
  std::uint64_t trials = 0;
  // Returns a greater number for a later row, so that the later row replaces the earlier row. If
  // two rows have equally many trials, the row with a problem is the later one, because a problem
  // counts until a further trial is stored.
  std::uint64_t progress() const { return 2 * trials + (what.empty() ? 0 : 1); }
};
ASSAY_FIELDS(HarnessProblem, what, trials)

// The number of cases that it took to find a planted fault.
struct FaultProof {
  static constexpr const char* kind = "fault";
  std::string fault, law;
  FaultStatus status = FaultStatus::planted;
  bool curated = false;  // the curated case of the fault shows it
  // For each seed the number of random cases until the fault showed; nothing if the fault did not
  // show within `cases` random cases.
  std::vector<std::optional<std::uint64_t>> needed;
  std::uint64_t cases = 0;           // greatest number of random cases tried under each seed
  bool time_over = false;            // a time limit ended the hunt
  std::uint64_t known_vertices = 0;  // of the smallest known mesh that shows the fault; 0: unknown

  bool is_found() const;         // by its curated case, or by a random case under any seed
  bool found_at_random() const;  // by a random case under any seed
  // Returns whether the fault was tried on as many cases and seeds as the plan wants.
  bool is_whole(const CampaignPlan& plan) const;
  // Returns the median of `needed`. A seed under which the fault did not show counts as infinite;
  // the result is nothing if the median is infinite.
  std::optional<std::uint64_t> median() const;
  // Adds the cases of another hunt for the same fault, in a run under another seed.
  void add(const FaultProof& other);

  const std::string& key() const { return fault; }
  // Returns more for a complete hunt than for any hunt that a time limit ended.
  std::uint64_t progress() const;
};
ASSAY_FIELDS(FaultProof, fault, law, status, curated, needed, cases, time_over, known_vertices)

// The other run of the same build from which this run took over the proofs that planted faults are
// found.
struct PowerSource {
  static constexpr const char* kind = "power";
  std::string campaign, detector;
  std::uint64_t seed = 0;
  std::string program, worker, generator;  // SHA-256
  std::string rows;                        // digest of the other run's rows (RunFindings::rows)
  const std::string& key() const { return campaign; }
};
ASSAY_FIELDS(PowerSource, campaign, detector, seed, program, worker, generator, rows)
struct PowerProof {
  PowerSource source;
  std::vector<FaultProof> faults;
};

// How far a world of tetrahedra was proved (tetrahedron_world.h).
struct World {
  static constexpr const char* kind = "world";
  static constexpr bool may_differ = true;
  std::string world;
  std::uint64_t classes = 0, motions = 0, all = 0, collisions = 0;
  bool complete = false;
  std::optional<std::string> counterexample;  // the check that fails, in words
  const std::string& key() const { return world; }
  // Returns more for a counterexample than for any number of classes that hold.
  std::uint64_t progress() const;
};
ASSAY_FIELDS(World, world, classes, motions, all, collisions, complete, counterexample)

// The isolation of a plug-in's process throughout a run. `asked` is the word that the user gave,
// or empty if there was no word; `got` is the word for the isolation that the process had.
struct PluginIsolation {
  static constexpr const char* kind = "isolation";
  std::string asked, got;
};
ASSAY_FIELDS(PluginIsolation, asked, got)

// The gates that a verb of the command line asks for.
struct VerbRequest {
  static constexpr const char* kind = "asked";
  std::vector<std::string> gates;  // names of gates.h; no other gate is judged
  bool certificate = false;        // the verb issues a certificate, so every gate is judged
};
ASSAY_FIELDS(VerbRequest, gates, certificate)

// Versions of the program that issued a certificate, of its libraries, and of its cases.
struct Versions {
  static constexpr const char* kind = "versions";
  std::string assay;
  std::optional<std::string> commit;
  std::string libraries;
  std::string corpus{};  // SHA-256 over names and bytes of all cases, own cases too
};
ASSAY_FIELDS(Versions, assay, commit, libraries, corpus)

// The result of one input in one configuration. The input is a part of the shipped corpus, a scene,
// or the owner's cases; a large mesh, which a plug-in runs several times if it claims to be
// deterministic; a lane of the search; or a family of queries of the self-test. Members that do not
// apply to the input keep their defaults.
struct JudgedSource {
  static constexpr const char* kind = "judged";
  struct Failed {
    std::string id, signature, what;
  };
  // A step of a large mesh that the oracle judged. `contacts`: pairs in contact that the contract
  // does not leave out.
  struct Step {
    std::uint64_t step = 0, contacts = 0;  // the step's place, from 1
    bool holds = false;
  };
  Source source = Source::corpus;
  // For a lane, `input` is its number, from 1, with leading zeros, and `configuration` is empty.
  // Only whole lanes are stored.
  std::string input{}, configuration{};
  std::uint64_t planned = 0;  // for a lane: the number of its cases
  // `cases`: cases that were judged (steps of a large mesh). `defects`: cases that break a claim or
  // contradict the oracle. `undecided`: for lanes and queries, cases without a verdict.
  std::uint64_t cases = 0, left_out = 0, steps = 0, collisions = 0, pairs = 0;
  std::uint64_t defects = 0, undecided = 0;
  bool complete = true;  // all queries of the family were asked
  // `failed` lists the cases that do not hold, `open` the cases without an answer.
  std::vector<Failed> failed{}, open{};
  // The extremes of the cases with a judged step; and the triangles of the largest mesh with a
  // contact that the contract does not leave out.
  Extremes extremes{};
  std::uint64_t triangles_in_contact = 0;
  // Only for a large mesh.
  std::uint64_t triangles = 0;
  std::uint64_t runs = 0;                // runs that ended by themselves
  std::vector<std::uint64_t> threads{};  // for each run the greatest number of its threads
  std::string what{};                    // how two runs differ, or why a run ended early
  bool broken = false;                   // `what` describes a broken claim
  std::vector<Step> judged{};
  std::set<std::string> causes{};  // the causes (cause.h) in the hardest cases of a lane's archive

  std::string key() const { return input + ", " + configuration + ", " + name_of(source); }
};
ASSAY_FIELDS(JudgedSource::Failed, id, signature, what)
ASSAY_FIELDS(JudgedSource::Step, step, contacts, holds)
ASSAY_FIELDS(JudgedSource, source, input, configuration, planned, cases, left_out, steps,
             collisions, pairs, defects, undecided, complete, failed, open, extremes,
             triangles_in_contact, triangles, runs, threads, what, broken, judged, causes)

// The ratio of the times of two programs that were run alternately.
struct SpeedFigure {
  static constexpr const char* kind = "speed";
  static constexpr bool may_differ = true;
  std::string name;
  double median = 0, lo = 0, hi = 0;
  std::vector<double> samples;
  const std::string& key() const { return name; }
};
ASSAY_FIELDS(SpeedFigure, name, median, lo, hi, samples)

// Where and when a certificate was issued, and how long that took.
struct Issuance {
  static constexpr const char* kind = "issued";
  static constexpr bool may_differ = true;
  std::string out, detector{};
  std::string own_cases{};  // empty: none
  std::string data{};       // folder of the public sequences; empty: none
  std::string at{};         // UTC, 2026-01-31T12:00:00Z; empty: not issued yet
  double seconds = 0;
};
ASSAY_FIELDS(Issuance, out, detector, own_cases, data, at, seconds)

// The contents of all evidence rows of one store, or of several stores. Each list is ordered by
// store, then by key.
struct EvidenceFacts {
  std::vector<Canary> canaries;
  std::vector<HarnessProblem> problems;
  std::vector<FaultProof> faults;
  std::vector<PowerSource> power;
  std::vector<World> worlds;
  std::optional<VerbRequest> request;
  std::optional<Versions> versions;
  std::vector<PluginIsolation> isolation;
  std::vector<JudgedSource> sources;
  std::vector<SpeedFigure> speed;
  std::optional<Issuance> issued;

  // Return the rows of a source, and the sum of these rows. The rows of Source::corpus include the
  // owner's cases.
  std::vector<JudgedSource> rows_of(Source source) const;
  JudgedSource sum_of(Source source) const;

  // Adds the contents of a row. Throws StoreProblem if no run stores such a row.
  void take(const Row& row);
  // Adds the evidence of a run of the same campaign under another seed. The corpus and the
  // self-test, which every run does in the same way, count once; the cases of a planted fault add
  // up. Throws StoreProblem if the runs have different requests or versions, or took over different
  // proofs of planted faults.
  void add(EvidenceFacts other);
};
EvidenceFacts facts_in(const Store& store);

using AnyEvidence =
    std::variant<Canary, HarnessProblem, FaultProof, PowerSource, World, VerbRequest, Versions,
                 PluginIsolation, JudgedSource, SpeedFigure, Issuance>;
Row to_row(const AnyEvidence& evidence);

// Returns whether two runs of one campaign may differ in this row. REQUIRES a row of evidence.
bool may_differ(const Row& row);

}  // namespace assay::properties
