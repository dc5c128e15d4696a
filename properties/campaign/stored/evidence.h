// What a run finds out besides its trials: one struct for each kind of evidence, and the functions
// that turn it into a store's row and back. Only evidence.cpp names the kinds and the keys of
// their facts.
//
// Facts hold no times, so that two runs of one campaign have equal rows. What may differ between
// two runs has kinds of its own: times (SpeedFigure, Issued), a World, which its limit of time may
// end early, and a SlowCase.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/plan.h"
#include "properties/campaign/stored/store.h"
#include "properties/faults/fault.h"

namespace assay::properties {

// Words that stand where the name of a shard ("1/4") is expected: for a file that holds several
// shards, for what belongs to no shard, and for proofs that were taken over from another run.
inline constexpr const char* merged_shard = "merged";
inline constexpr const char* checks_shard = "checks";
inline constexpr const char* power_shard = "power";

// A planted fault that every run must find. It is tried through a worker process, in the same way
// as the detector under test.
struct Canary {
  std::string fault, shard;
  std::optional<std::uint64_t> found_after;  // how many cases that took; nothing: it was not found
};

// What kept the harness itself from going on, after `trials` trials had been stored. `explanation`
// is empty when nothing did.
struct HarnessProblem {
  std::string shard, explanation;
  std::uint64_t trials = 0;
};

struct MeshCounts {
  std::uint64_t triangles = 0, vertices = 0, steps = 0;
};
struct ShrunkFault {
  MeshCounts before, after;
  std::uint64_t calls = 0;  // calls of the reducer's judge
};

// What it took to find a planted fault.
struct FaultProof {
  std::string fault, shard, law;
  FaultStatus status = FaultStatus::planted;
  bool curated = false;  // the curated case of the fault shows it
  // For each seed the number of random cases until the fault showed; nothing if it did not show
  // within `cases` of them.
  std::vector<std::optional<std::uint64_t>> needed;
  std::uint64_t cases = 0;
  bool time_over = false;            // the hunt was ended by a limit of time
  std::uint64_t known_vertices = 0;  // of the smallest known mesh that shows it; 0: unknown
  std::optional<ShrunkFault> shrunk;

  bool found() const;            // by its curated case, or by a random one under any seed
  bool found_at_random() const;  // by a random case under any seed
  // Whether the fault was tried on as many cases and seeds as the plan gives to a fault.
  bool is_whole(const CampaignPlan& plan) const;
  // The median of `needed`. A seed under which the fault did not show counts as more than any
  // number; the result is nothing when the median is such a seed.
  std::optional<std::uint64_t> median() const;
};

// From which run of the same build the proofs of planted faults were taken.
struct PowerSource {
  std::string campaign, detector;
  std::uint64_t seed = 0;
  std::string program, worker, generator;  // SHA-256
  std::string rows;                        // digest of that run's rows
};
struct PowerProof {
  PowerSource source;
  std::vector<FaultProof> faults;
};

// How far a world of tetrahedra was proved (tetrahedron_world.h).
struct World {
  std::string world, shard;
  std::uint64_t classes = 0, motions = 0, all = 0, collisions = 0;
  bool complete = false;
  std::optional<std::string> counterexample;  // what does not hold
};

// How well the process of a plug-in was isolated in all trials of a shard, or in the corpus (shard
// "checks"), in the words of isolation.h.
struct PluginIsolation {
  std::string shard, asked, got;
};

// A trial that reached the limit of a case, or came near it.
struct SlowCase {
  std::string id, configuration, shard;
  bool undecided = false;  // it reached the limit of a case
  double seconds = 0;      // processor time that it took, unless it is undecided
  double limit = 0;        // the limit of a case, in seconds
  // Case files as text. `smallest` takes at least twice the limit; it is empty if no such case is
  // known.
  std::string mesh, smallest;
};

// A large mesh that was put to a plug-in, several times where it claims to be deterministic, to try
// its claims on more than the trials.
struct Repetition {
  // A step that the oracle judged. `contacts`: pairs in contact that the contract does not leave
  // out.
  struct Judged {
    std::uint64_t step = 0, contacts = 0;  // the step's place, from 1
    bool holds = false;
  };
  std::string input, configuration, shard;
  std::uint64_t triangles = 0, steps = 0;
  std::uint64_t runs = 0;              // runs that ended by themselves
  std::vector<std::uint64_t> threads;  // how many it might use, run by run
  std::string difference;              // how two runs differ, or one ended early
  bool broken = false;                 // `difference` breaks a claim
  std::vector<Judged> judged{};
};

// What a verb asked of a run.
struct Asked {
  std::vector<std::string> gates;  // names of gates.h; no other gate is judged
  bool certificate = false;        // a certificate is to be issued: every gate is asked for
};

// What issued a certificate: versions of the program and of its libraries.
struct Versions {
  std::string assay;
  std::optional<std::string> commit;
  std::string libraries;
};
struct Paths {
  std::string out, detector;
  std::string own_cases{};  // empty: none
  std::string data{};       // folder of the public sequences; empty: none
};
struct InputDigests {
  std::string corpus;                  // SHA-256 over names and bytes of all cases, own cases too
  std::optional<std::string> waivers;  // of corpus/known.json and the owner's waivers
};

// A known failure that a certificate excuses until the day on which the waiver expires.
struct StoredWaiver {
  std::string signature, reason, link, expires;
  bool expired = false;  // it had expired when the certificate was issued
};

// The name of the input that the owner's own cases are, and what their ids begin with.
inline constexpr const char* own_cases_input = "own cases";
inline constexpr const char* own_cases_in_id = "own/";

// What one input came to in one configuration. An input is a part of the shipped corpus, a scene,
// or the owner's cases.
struct CorpusRow {
  struct Failed {
    std::string id, signature, explanation;
  };
  // `failed` lists the cases that do not hold, `open` those without an answer, of which nothing is
  // known.
  std::string input, configuration;
  std::uint64_t cases = 0, left_out = 0, steps = 0, collisions = 0, pairs = 0, defects = 0;
  std::vector<Failed> failed, open;
  // The largest mesh of which a step was judged, and the largest with a contact that the contract
  // does not leave out.
  std::uint64_t triangles = 0, triangles_in_contact = 0;
};

// What one family of queries of the self-test came to.
struct SelfTestRow {
  std::string family;
  std::uint64_t queries = 0, contacts = 0, contradictions = 0, open = 0;
  bool complete = false;
};

// A ratio of the times of two things that were run in turn.
struct SpeedFigure {
  std::string name;
  double median = 0, lo = 0, hi = 0;
  std::vector<double> samples;
};

// When a certificate was issued, and how long that took.
struct Issued {
  std::string at;  // UTC, 2026-01-31T12:00:00Z
  double seconds = 0;
};

// All that the evidence rows of some stores say. Each list is in the order of names, then of
// shards.
struct EvidenceFacts {
  std::vector<Canary> canaries;
  std::vector<HarnessProblem> problems;
  std::vector<FaultProof> faults;
  std::vector<PowerSource> power;
  std::vector<World> worlds;
  std::optional<Asked> asked;
  std::optional<Versions> versions;
  std::optional<Paths> paths;
  std::vector<PluginIsolation> isolation;
  std::vector<SlowCase> slow;
  std::vector<Repetition> repeated;
  std::optional<InputDigests> inputs;
  std::vector<StoredWaiver> waivers;
  std::vector<CorpusRow> corpus;
  std::vector<SelfTestRow> self_test;
  std::vector<SpeedFigure> speed;
  std::optional<Issued> issued;

  // Throws StoreProblem on a row that no run stores.
  void take(const Evidence& row);
};

// The row in which the evidence is stored. Evidence without a shard goes under `checks_shard`.
Evidence to_row(const Canary& canary);
Evidence to_row(const HarnessProblem& problem);
Evidence to_row(const FaultProof& proof);
Evidence to_row(const PowerSource& source);
Evidence to_row(const World& world);
Evidence to_row(const PluginIsolation& isolation);
Evidence to_row(const SlowCase& slow);
Evidence to_row(const Repetition& repetition);
Evidence to_row(const Asked& asked);
Evidence to_row(const Versions& versions);
Evidence to_row(const Paths& paths);
Evidence to_row(const InputDigests& digests);
Evidence to_row(const StoredWaiver& waiver);
Evidence to_row(const CorpusRow& row);
Evidence to_row(const SelfTestRow& row);
Evidence to_row(const SpeedFigure& figure);
Evidence to_row(const Issued& issued);

// Removes what an earlier run stored of a kind, before the same work is done again.
enum class DroppedKind { fault, waiver, corpus, self_test, times };
void drop(Store& store, DroppedKind kind);

// Whether two runs of one campaign may differ in this row. It then holds times, paths of files, a
// World or a SlowCase.
bool may_differ(const Evidence& row);

}  // namespace assay::properties
