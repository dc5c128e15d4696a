// What a run finds out besides its trials: one struct a kind, to a store's row and from one. Kinds
// and keys of facts are named in evidence.cpp and nowhere else.
//
// Facts hold no times, so that two runs of one campaign have equal rows: times have kinds of their
// own (SpeedFigure, Issued), and so has a World, which may end by its time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/plan.h"
#include "properties/campaign/stored/store.h"
#include "properties/faults/fault.h"

namespace assay::properties {

// The shard of a file that holds several, of what belongs to none, and of proofs taken over.
inline constexpr const char* merged_shard = "merged";
inline constexpr const char* checks_shard = "checks";
inline constexpr const char* power_shard = "power";

// A planted fault that every run must find, on the way that the detector under test goes.
struct Canary {
  std::string fault, shard;
  std::optional<std::uint64_t> found_after;  // cases; nothing: it was not found
};

// What kept the harness itself from going on when so many trials were stored; empty: nothing.
struct HarnessProblem {
  std::string shard, what;
  std::uint64_t trials = 0;
};

struct MeshCounts {
  std::uint64_t triangles = 0, vertices = 0, steps = 0;
};
struct ShrunkFault {
  MeshCounts before, after;
  std::uint64_t calls = 0;  // of the reducer's judge
};

// What it took to find a planted fault.
struct FaultProof {
  std::string fault, shard, law;
  FaultStatus status = FaultStatus::planted;
  bool curated = false;  // its curated case shows it
  // For each seed the random cases until it showed; nothing: not within `cases`.
  std::vector<std::optional<std::uint64_t>> needed;
  std::uint64_t cases = 0;
  bool time_over = false;            // the hunt was ended by a limit of time
  std::uint64_t known_vertices = 0;  // of the smallest mesh known that shows it; 0: none is known
  std::optional<ShrunkFault> shrunk;

  bool found() const;  // by its curated case, or by a random one under any seed
  // Whether it had all the cases that the plan gives to a fault, under every seed.
  bool is_whole(const CampaignPlan& plan) const;
  // Over the seeds, those without counted as above all; nothing when that is one of them.
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

// A world of tetrahedra, as far as it was proved (tetrahedron_world.h).
struct World {
  std::string world, shard;
  std::uint64_t classes = 0, motions = 0, all = 0, collisions = 0;
  bool complete = false;
  std::optional<std::string> counterexample;  // what does not hold
};

// How a shard's plug-in was kept apart in all of its trials, or in the corpus ("checks"), by the
// words of isolation.h.
struct PluginIsolation {
  std::string shard, asked, got;
};

// A trial that reached the limit of a case, or came near it.
struct SlowCase {
  std::string id, configuration, shard;
  bool undecided = false;  // it reached the limit
  double seconds = 0;      // of processor time, where it did not
  double limit = 0;        // of a case
  // Case files as text; smallest: one that takes at least twice the limit, empty where none is
  // known.
  std::string mesh, smallest;
};

// A large mesh that was put to a plug-in several times: what the claim `deterministic` was tried on
// besides the trials.
struct Repetition {
  std::string input, configuration, shard;
  std::uint64_t triangles = 0, steps = 0;
  std::uint64_t runs = 0;              // that ended by themselves
  std::vector<std::uint64_t> threads;  // told to it, in the order of the runs
  std::string what;                    // where two runs differ, or one ended early; empty: neither
  bool broken = false;                 // `what` breaks a claim
};

// What a verb asked of a run.
struct Asked {
  std::vector<std::string> gates;  // by the names of gates.h; any other gate is not judged
  bool certificate = false;        // to issue one: then every gate is asked for
};

// Who issued a certificate, and where from.
struct Versions {
  std::string assay;
  std::optional<std::string> commit;
  std::string libraries;
};
struct Paths {
  std::string out, detector;
  std::string own_cases{};  // empty: none
  std::string data{};       // of the public sequences; empty: none
};
struct InputDigests {
  std::string corpus;                  // names and bytes of the shipped cases, and of the owner's
  std::optional<std::string> waivers;  // corpus/known.json, and the owner's
};

// A known failure that a certificate leaves aside until the day on which it expires.
struct StoredWaiver {
  std::string signature, reason, link, expires;
  bool expired = false;  // when the certificate was issued
};

// The input of the cases that an owner gives, and what stands before their ids.
inline constexpr const char* own_cases_input = "own cases";
inline constexpr const char* own_cases_in_id = "own/";

// An input of the shipped corpus, a scene, or the owner's cases, in one configuration.
struct CorpusRow {
  struct Failed {
    std::string id, signature, what;
  };
  // `failed`: what does not hold. `open`: what has no answer, so that nothing is known of it.
  std::string input, configuration;
  std::uint64_t cases = 0, left_out = 0, steps = 0, collisions = 0, pairs = 0, defects = 0;
  std::vector<Failed> failed, open;
};

// A family of queries of the self-test.
struct SelfTestRow {
  std::string family;
  std::uint64_t queries = 0, contacts = 0, contradictions = 0, open = 0;
  bool complete = false;
};

// A ratio of interleaved runs.
struct SpeedFigure {
  std::string what;
  double median = 0, lo = 0, hi = 0;
  std::vector<double> samples;
};

// When a certificate was issued, and how long that took.
struct Issued {
  std::string at;  // UTC, 2026-01-31T12:00:00Z
  double seconds = 0;
};

// All that the rows of some stores say, in the order of their names and shards.
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

// The row of what a shard found out. What belongs to no shard stands in that of `checks_shard`.
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

// Takes away what an earlier run left of a kind, before the work is done again.
enum class DroppedKind { fault, waiver, corpus, self_test, times };
void drop(Store& store, DroppedKind kind);

// Whether two runs of one campaign may differ in it: times, and where they were kept.
bool may_differ(const Evidence& row);

}  // namespace assay::properties
