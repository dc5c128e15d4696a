#include "properties/campaign/ledger/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {

// The fields of a row are the members of its struct, by their names. The exception is the key
// "what", under which rows store a line of text.
#define ASSAY_FIELDS_WITH_KEYS(Type, ...)                                                \
  void to_json(nlohmann::json& j, const Type& x) {                                       \
    const auto field = [&](const char* key, const auto& member) { j[key] = member; };    \
    __VA_ARGS__;                                                                         \
  }                                                                                      \
  void from_json(const nlohmann::json& j, Type& x) {                                     \
    const auto field = [&](const char* key, auto& member) { j.at(key).get_to(member); }; \
    __VA_ARGS__;                                                                         \
  }

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Canary, fault, shard, found_after)
ASSAY_FIELDS_WITH_KEYS(HarnessProblem, field("shard", x.shard), field("what", x.explanation),
                       field("trials", x.trials))
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeshCounts, triangles, vertices, steps)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ShrunkFault, before, after, calls)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FaultProof, fault, shard, law, status, curated, needed, cases,
                                   time_over, known_vertices, shrunk)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PowerSource, campaign, detector, seed, program, worker,
                                   generator, rows)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(World, world, shard, classes, motions, all, collisions, complete,
                                   counterexample)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PluginIsolation, shard, asked, got)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SlowCase, id, configuration, shard, undecided, seconds, limit,
                                   mesh, smallest)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Repetition::Judged, step, contacts, holds)
ASSAY_FIELDS_WITH_KEYS(Repetition, field("input", x.input), field("configuration", x.configuration),
                       field("shard", x.shard), field("triangles", x.triangles),
                       field("steps", x.steps), field("runs", x.runs), field("threads", x.threads),
                       field("what", x.difference), field("broken", x.broken),
                       field("judged", x.judged))
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AskedAgain, shard, cases, steps, wrong, open)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Asked, gates, certificate)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Versions, assay, commit, libraries)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Paths, out, detector, own_cases, data)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InputDigests, corpus, waivers)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StoredWaiver, signature, reason, link, expires, expired)
ASSAY_FIELDS_WITH_KEYS(CorpusRow::Failed, field("id", x.id), field("signature", x.signature),
                       field("what", x.explanation))
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CorpusRow, input, configuration, cases, left_out, steps,
                                   collisions, pairs, defects, failed, open, triangles,
                                   triangles_in_contact)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SelfTestRow, family, queries, contacts, contradictions, open,
                                   complete)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SpeedFigure, name, median, lo, hi, samples)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Issued, at, seconds)

void to_json(nlohmann::json& j, FaultStatus status) { j = name_of(status); }
void from_json(const nlohmann::json& j, FaultStatus& status) {
  for (const auto one : {FaultStatus::planted, FaultStatus::open, FaultStatus::equivalent}) {
    if (j == name_of(one)) return void(status = one);
  }
  throw StoreProblem(fmt::format("no status of a fault: {}", corpus::json_text(j)));
}

namespace {

// The shard stands in the row alone.
template <class T>
constexpr bool has_shard = requires(T& x, const Row& row) {
  x.shard = row.shard;
};

// Throws StoreProblem if the row is not what to_row makes of what it says: then its key, its shard
// or its progress are of something else.
template <class T>
T told(const Row& row) {
  T x;
  if constexpr (has_shard<T>) {
    Row with_shard = row;
    auto fields = fields_of(row);
    if (fields.is_object()) fields.emplace("shard", row.shard);
    with_shard.fields = corpus::json_text(fields);
    x = read_fields_of<T>(with_shard);
  } else {
    x = read_fields_of<T>(row);
  }
  if (to_row(x) != row)
    throw StoreProblem(fmt::format("{} is not as a run writes it", row_name(row)));
  return x;
}

// What the row says becomes one of the list, or the only one, if the row is of its kind.
template <class T>
bool takes(std::vector<T>& list, const Row& row) {
  if (row.kind != T::kind) return false;
  list.push_back(told<T>(row));
  return true;
}
template <class T>
bool takes(std::optional<T>& only, const Row& row) {
  if (row.kind != T::kind) return false;
  only = told<T>(row);
  return true;
}

template <class... T>
bool is_of_kind_that_may_differ(const Row& row, const std::variant<T...>*) {
  return ((row.kind == T::kind && requires { T::may_differ; }) || ...);
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

std::uint64_t FaultProof::progress() const {
  const auto found =
      std::count_if(needed.begin(), needed.end(), [](const auto& n) { return n.has_value(); });
  return time_over ? static_cast<std::uint64_t>(found) : needed.size() + 1;
}

std::uint64_t World::progress() const {
  constexpr std::uint64_t farthest = std::numeric_limits<std::int64_t>::max();
  return counterexample ? farthest : classes;
}

std::uint64_t SlowCase::progress() const {
  constexpr std::uint64_t longest = 1'000'000'000;
  return smallest.empty() ? 1 : longest - std::min<std::uint64_t>(smallest.size(), longest - 2);
}

Row to_row(const AnyEvidence& evidence) {
  return std::visit(
      []<class T>(const T& x) {
        nlohmann::json fields = x;
        if constexpr (has_shard<T>) fields.erase("shard");
        Row row{T::kind, "", checks_shard, 1, corpus::json_text(fields)};
        if constexpr (requires { x.key(); }) row.key = x.key();
        if constexpr (requires { x.shard; }) row.shard = x.shard;
        if constexpr (requires { x.progress(); }) row.progress = x.progress();
        return row;
      },
      evidence);
}

void EvidenceFacts::take(const Row& row) {
  const auto is_taken = [&](auto&... lists) { return (takes(lists, row) || ...); };
  if (!is_taken(canaries, problems, faults, power, worlds, asked, versions, paths, isolation, slow,
                repeated, asked_again, inputs, waivers, corpus, self_test, speed, issued))
    throw StoreProblem(fmt::format("no run stores {}", row_name(row)));
}

EvidenceFacts facts_in(const Store& store) {
  EvidenceFacts facts;
  for (const auto& row : store.evidence()) facts.take(row);
  return facts;
}

bool may_differ(const Row& row) {
  return is_of_kind_that_may_differ(row, static_cast<const AnyEvidence*>(nullptr));
}

}  // namespace assay::properties
