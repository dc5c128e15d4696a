// Evidence that a run stores besides its trials: one struct for each kind, and the functions that
// turn it into a row of the ledger and back. Each struct states its kind and may have key() and
// progress(), which go into the row; the fields of the row are the members. A line of text is
// called `what` in all rows.
//
// Two runs of one campaign have equal rows, unless the kind `may_differ`: times and paths
// (SpeedFigure, Issuance), and a World, which its limit of time may end early.
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
  std::optional<std::uint64_t> found_after;  // cases until it was found; nothing: it was not
  const std::string& key() const { return fault; }
};
ASSAY_FIELDS(Canary, fault, found_after)

// A problem that kept the harness itself from going on, after `trials` trials had been stored.
// `what` is empty if there was none.
struct HarnessProblem {
  static constexpr const char* kind = "problem";
  std::string what;
  std::uint64_t trials = 0;
  // Returns a number by which the later of two rows replaces the earlier one: it is greater for the
  // later row. Of two rows with equally many trials, the one with a problem is the later one,
  // because a problem ends only when a further trial is stored.
  std::uint64_t progress() const { return 2 * trials + (what.empty() ? 0 : 1); }
};
ASSAY_FIELDS(HarnessProblem, what, trials)

// The number of cases that it took to find a planted fault.
struct FaultProof {
  static constexpr const char* kind = "fault";
  std::string fault, law;
  FaultStatus status = FaultStatus::planted;
  bool curated = false;  // the curated case of the fault shows it
  // For each seed the number of random cases until the fault showed; nothing if it did not show
  // within `cases` of them.
  std::vector<std::optional<std::uint64_t>> needed;
  std::uint64_t cases = 0;           // tried under each seed, unless the fault showed before
  bool time_over = false;            // the hunt was ended by a limit of time
  std::uint64_t known_vertices = 0;  // of the smallest known mesh that shows the fault; 0: unknown

  bool is_found() const;         // by its curated case, or by a random one under any seed
  bool found_at_random() const;  // by a random case under any seed
  // Returns whether the fault was tried on as many cases and seeds as the plan gives to a fault.
  bool is_whole(const CampaignPlan& plan) const;
  // Returns the median of `needed`. A seed under which the fault did not show counts as more than
  // any number; the result is nothing if the median is such a seed.
  std::optional<std::uint64_t> median() const;
  // Adds the cases of another hunt for the same fault, in a run under another seed.
  void add(const FaultProof& other);

  const std::string& key() const { return fault; }
  // Returns more for a hunt that went to its end than for any that the time ended.
  std::uint64_t progress() const;
};
ASSAY_FIELDS(FaultProof, fault, law, status, curated, needed, cases, time_over, known_vertices)

// The run of the same build from which the proofs of planted faults were taken.
struct PowerSource {
  static constexpr const char* kind = "power";
  std::string campaign, detector;
  std::uint64_t seed = 0;
  std::string program, worker, generator;  // SHA-256
  std::string rows;                        // digest of that run's rows
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
  std::optional<std::string> counterexample;  // the claim that fails, in words
  const std::string& key() const { return world; }
  // Returns more for a counterexample than for any number of classes that hold.
  std::uint64_t progress() const;
};
ASSAY_FIELDS(World, world, classes, motions, all, collisions, complete, counterexample)

// How the process of a plug-in was isolated throughout a run: the word that was asked for, empty if
// none was, and the word for the isolation that it had.
struct PluginIsolation {
  static constexpr const char* kind = "isolation";
  std::string asked, got;
};
ASSAY_FIELDS(PluginIsolation, asked, got)

// The request of a verb to a run.
struct VerbRequest {
  static constexpr const char* kind = "asked";
  std::vector<std::string> gates;  // names of gates.h; no other gate is judged
  bool certificate = false;        // a certificate is to be issued: every gate is asked for
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
// or the owner's cases; a large mesh, on which a plug-in's claims are tried (several times, if it
// claims to be deterministic); a lane of the search; or a family of queries of the self-test. Each
// fills the members that apply to it.
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
  std::uint64_t planned = 0;  // for a lane: how many cases it was to ask
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
  std::vector<std::uint64_t> threads{};  // the number it may use, run by run
  std::string what{};                    // how two runs differ, or why one ended early
  bool broken = false;                   // `what` breaks a claim
  std::vector<Step> judged{};
  std::set<std::string> causes{};  // in the hardest cases of a lane's archive (cause.h)

  std::string key() const { return input + ", " + configuration + ", " + name_of(source); }
};
ASSAY_FIELDS(JudgedSource::Failed, id, signature, what)
ASSAY_FIELDS(JudgedSource::Step, step, contacts, holds)
ASSAY_FIELDS(JudgedSource, source, input, configuration, planned, cases, left_out, steps,
             collisions, pairs, defects, undecided, complete, failed, open, extremes,
             triangles_in_contact, triangles, runs, threads, what, broken, judged, causes)

// The ratio of the times of two programs that were run in turn.
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

// All that the evidence rows of some stores say. Each list is in the order of stores, then of
// names.
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

  // Return the inputs of a source, and their sum. The owner's cases are a part of the corpus.
  std::vector<JudgedSource> rows_of(Source source) const;
  JudgedSource sum_of(Source source) const;

  // Throws StoreProblem on a row that no run stores.
  void take(const Row& row);
  // Adds the evidence of a run of the same campaign under another seed. The corpus and the
  // self-test, which every run does in the same way, count once; the cases of a planted fault add
  // up. Throws StoreProblem if the two judged different inputs, or took over different proofs.
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
