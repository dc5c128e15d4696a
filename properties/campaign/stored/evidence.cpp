#include "properties/campaign/stored/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "corpus/json_fields.h"
#include "properties/campaign/stored/json_optional.h"

namespace assay::properties {

// The keys of the facts are stated once for both directions, reading and writing. They are the
// names of the members. The exception is the key "what", under which rows store a line of text.
// What a row's name or shard says is no fact.
#define FACT_WITH_KEYS(Type, ...)                                                        \
  void to_json(nlohmann::json& j, const Type& x) {                                       \
    const auto field = [&](const char* key, const auto& member) { j[key] = member; };    \
    __VA_ARGS__;                                                                         \
  }                                                                                      \
  void from_json(const nlohmann::json& j, Type& x) {                                     \
    const auto field = [&](const char* key, auto& member) { j.at(key).get_to(member); }; \
    __VA_ARGS__;                                                                         \
  }

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Canary, found_after)
FACT_WITH_KEYS(HarnessProblem, field("what", x.explanation))
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeshCounts, triangles, vertices, steps)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ShrunkFault, before, after, calls)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FaultProof, law, status, curated, needed, cases, time_over,
                                   known_vertices, shrunk)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PowerSource, campaign, detector, seed, program, worker,
                                   generator, rows)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(World, classes, motions, all, collisions, complete,
                                   counterexample)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PluginIsolation, asked, got)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SlowCase, id, configuration, undecided, seconds, limit, mesh,
                                   smallest)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Repetition::Judged, step, contacts, holds)
FACT_WITH_KEYS(Repetition, field("input", x.input), field("configuration", x.configuration),
               field("triangles", x.triangles), field("steps", x.steps), field("runs", x.runs),
               field("threads", x.threads), field("what", x.difference), field("broken", x.broken),
               field("judged", x.judged))
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Asked, gates, certificate)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Versions, assay, commit, libraries)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Paths, out, detector, own_cases, data)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InputDigests, corpus, waivers)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StoredWaiver, reason, link, expires, expired)
FACT_WITH_KEYS(CorpusRow::Failed, field("id", x.id), field("signature", x.signature),
               field("what", x.explanation))
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CorpusRow, input, configuration, cases, left_out, steps,
                                   collisions, pairs, defects, failed, open, triangles,
                                   triangles_in_contact)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SelfTestRow, queries, contacts, contradictions, open, complete)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SpeedFigure, median, lo, hi, samples)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Issued, at, seconds)

void to_json(nlohmann::json& j, FaultStatus status) { j = name_of(status); }
void from_json(const nlohmann::json& j, FaultStatus& status) {
  for (const auto one : {FaultStatus::planted, FaultStatus::open, FaultStatus::equivalent}) {
    if (j == name_of(one)) return void(status = one);
  }
  throw StoreProblem(fmt::format("no status of a fault: {}", corpus::json_text(j)));
}

namespace {

using Json = nlohmann::json;

// These are the kinds of rows.
constexpr char canary_kind[] = "canary", problem_kind[] = "problem", fault_kind[] = "fault",
               power_kind[] = "power", world_kind[] = "world", slow_kind[] = "slow",
               repeated_kind[] = "repeated", asked_kind[] = "asked", subject_kind[] = "subject",
               digest_kind[] = "digest", waiver_kind[] = "waiver", corpus_kind[] = "corpus",
               self_test_kind[] = "self-test", times_kind[] = "times";

// If a kind has few rows, these are their names.
constexpr char trials_name[] = "trials", versions_name[] = "versions", paths_name[] = "paths",
               isolation_name[] = "isolation", inputs_name[] = "inputs", issued_name[] = "issued";

template <class T>
Evidence row(const char* kind, const std::string& name, const std::string& shard, const T& facts,
             std::uint64_t progress = 1) {
  return {kind, name, shard, progress, corpus::json_text(Json(facts))};
}

// Returns `facts` after reading into it what the facts of the row say.
template <class T>
T told(const Evidence& row, T facts = {}) {
  const auto read = corpus::parse_sorted_json(row.facts, row.name);
  if (!read) throw StoreProblem(fmt::format("evidence {} {}", row.kind, read.error().message));
  read.value().get_to(facts);
  return facts;
}

}  // namespace

bool FaultProof::found() const { return curated || found_at_random(); }

bool FaultProof::found_at_random() const {
  return std::any_of(needed.begin(), needed.end(), [](const auto& n) { return n.has_value(); });
}

bool FaultProof::is_whole(const CampaignPlan& plan) const {
  return !time_over && cases >= plan.fault_cases &&
         needed.size() >= static_cast<std::size_t>(plan.fault_seeds);
}

std::optional<std::uint64_t> FaultProof::median() const {
  if (needed.empty()) return std::nullopt;
  auto sorted = needed;
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a && (!b || *a < *b); });
  return sorted[(sorted.size() - 1) / 2];
}

Evidence to_row(const Canary& x) { return row(canary_kind, x.fault, x.shard, x); }
Evidence to_row(const HarnessProblem& x) {
  // A later row replaces an earlier one. If both stand at the same number of trials, the one that
  // tells of a problem counts as later, because a problem is over when a further trial is stored
  // without one.
  return row(problem_kind, trials_name, x.shard, x, 2 * x.trials + (x.explanation.empty() ? 0 : 1));
}
Evidence to_row(const FaultProof& x) {
  // A hunt that was not ended by the time counts as farther than any that was.
  const auto all = static_cast<std::uint64_t>(x.needed.size()) + 1;
  const auto found = static_cast<std::uint64_t>(
      std::count_if(x.needed.begin(), x.needed.end(), [](const auto& n) { return n.has_value(); }));
  return row(fault_kind, x.fault, x.shard, x, x.time_over ? found : all);
}
Evidence to_row(const PowerSource& x) { return row(power_kind, x.campaign, power_shard, x); }
Evidence to_row(const World& x) {
  // A counterexample counts as farther than any number of classes that hold.
  constexpr std::uint64_t farthest = std::numeric_limits<std::int64_t>::max();
  return row(world_kind, x.world, x.shard, x, x.counterexample ? farthest : x.classes);
}
Evidence to_row(const SlowCase& x) {
  // A shrunk mesh counts as farther than none, and of two shrunk meshes the shorter counts as
  // farther.
  constexpr std::uint64_t longest = 1'000'000'000;
  const std::uint64_t progress =
      x.smallest.empty() ? 1 : longest - std::min<std::uint64_t>(x.smallest.size(), longest - 2);
  return row(slow_kind, x.id + ", " + x.configuration, x.shard, x, progress);
}
Evidence to_row(const Repetition& x) {
  return row(repeated_kind, x.input + ", " + x.configuration, x.shard, x);
}
Evidence to_row(const Asked& x) { return row(asked_kind, "gates", checks_shard, x); }
Evidence to_row(const PluginIsolation& x) { return row(subject_kind, isolation_name, x.shard, x); }
Evidence to_row(const Versions& x) { return row(subject_kind, versions_name, checks_shard, x); }
Evidence to_row(const Paths& x) { return row(subject_kind, paths_name, checks_shard, x); }
Evidence to_row(const InputDigests& x) { return row(digest_kind, inputs_name, checks_shard, x); }
Evidence to_row(const StoredWaiver& x) { return row(waiver_kind, x.signature, checks_shard, x); }
Evidence to_row(const CorpusRow& x) {
  return row(corpus_kind, x.input + ", " + x.configuration, checks_shard, x);
}
Evidence to_row(const SelfTestRow& x) { return row(self_test_kind, x.family, checks_shard, x); }
Evidence to_row(const SpeedFigure& x) { return row(times_kind, x.name, checks_shard, x); }
Evidence to_row(const Issued& x) { return row(times_kind, issued_name, checks_shard, x); }

void EvidenceFacts::take(const Evidence& r) try {
  if (r.kind == canary_kind) {
    canaries.push_back(told<Canary>(r, {r.name, r.shard, {}}));
  } else if (r.kind == problem_kind) {
    problems.push_back(told<HarnessProblem>(r, {r.shard, "", r.progress / 2}));
  } else if (r.kind == fault_kind) {
    faults.push_back(told<FaultProof>(r));
    faults.back().fault = r.name;
    faults.back().shard = r.shard;
  } else if (r.kind == power_kind) {
    power.push_back(told<PowerSource>(r));
  } else if (r.kind == world_kind) {
    worlds.push_back(told<World>(r));
    worlds.back().world = r.name;
    worlds.back().shard = r.shard;
  } else if (r.kind == slow_kind) {
    slow.push_back(told<SlowCase>(r));
    slow.back().shard = r.shard;
  } else if (r.kind == repeated_kind) {
    repeated.push_back(told<Repetition>(r));
    repeated.back().shard = r.shard;
  } else if (r.kind == asked_kind) {
    asked = told<Asked>(r);
  } else if (r.kind == subject_kind && r.name == versions_name) {
    versions = told<Versions>(r);
  } else if (r.kind == subject_kind && r.name == isolation_name) {
    isolation.push_back(told<PluginIsolation>(r, {r.shard, {}, {}}));
  } else if (r.kind == subject_kind && r.name == paths_name) {
    paths = told<Paths>(r);
  } else if (r.kind == digest_kind) {
    inputs = told<InputDigests>(r);
  } else if (r.kind == waiver_kind) {
    waivers.push_back(told<StoredWaiver>(r));
    waivers.back().signature = r.name;
  } else if (r.kind == corpus_kind) {
    corpus.push_back(told<CorpusRow>(r));
  } else if (r.kind == self_test_kind) {
    self_test.push_back(told<SelfTestRow>(r));
    self_test.back().family = r.name;
  } else if (r.kind == times_kind && r.name == issued_name) {
    issued = told<Issued>(r);
  } else if (r.kind == times_kind) {
    speed.push_back(told<SpeedFigure>(r));
    speed.back().name = r.name;
  } else {
    throw StoreProblem(fmt::format("no run stores evidence {} {}", r.kind, r.name));
  }
} catch (const nlohmann::json::exception& wrong) {
  throw StoreProblem(fmt::format("evidence {} {}: {}", r.kind, r.name, wrong.what()));
}

void drop(Store& store, DroppedKind kind) {
  switch (kind) {
    case DroppedKind::fault:
      store.drop_evidence(power_kind);
      return store.drop_evidence(fault_kind);
    case DroppedKind::waiver:
      return store.drop_evidence(waiver_kind);
    case DroppedKind::corpus:
      return store.drop_evidence(corpus_kind);
    case DroppedKind::self_test:
      return store.drop_evidence(self_test_kind);
    case DroppedKind::times:
      return store.drop_evidence(times_kind);
  }
}

bool may_differ(const Evidence& row) {
  const bool is_path = row.kind == subject_kind && row.name == paths_name;
  return row.kind == times_kind || row.kind == world_kind || row.kind == slow_kind || is_path;
}

}  // namespace assay::properties
