#include "properties/campaign/ledger/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {

// The fields of a row are the members of its struct. A line of text is called `what` in all rows.
ASSAY_FIELDS(Canary, fault, shard, found_after)
ASSAY_FIELDS(HarnessProblem, shard, what, trials)
ASSAY_FIELDS(MeshCounts, triangles, vertices, steps)
ASSAY_FIELDS(ShrunkFault, before, after, calls)
ASSAY_FIELDS(FaultProof, fault, shard, law, status, curated, needed, cases, time_over,
             known_vertices, shrunk)
ASSAY_FIELDS(PowerSource, campaign, detector, seed, program, worker, generator, rows)
ASSAY_FIELDS(World, world, shard, classes, motions, all, collisions, complete, counterexample)
ASSAY_FIELDS(PluginIsolation, shard, asked, got)
ASSAY_FIELDS(SlowCase, id, configuration, shard, undecided, seconds, limit, mesh, smallest)
ASSAY_FIELDS(Repetition::Judged, step, contacts, holds)
ASSAY_FIELDS(Repetition, input, configuration, shard, triangles, steps, runs, threads, what, broken,
             judged, extremes)
ASSAY_FIELDS(SearchedLane, lane, shard, cases, defects, open, causes)
ASSAY_FIELDS(Asked, gates, certificate)
ASSAY_FIELDS(Versions, assay, commit, libraries)
ASSAY_FIELDS(Paths, out, detector, own_cases, data)
ASSAY_FIELDS(InputDigests, corpus)
ASSAY_FIELDS(CorpusRow::Failed, id, signature, what)
ASSAY_FIELDS(CorpusRow, input, configuration, cases, left_out, steps, collisions, pairs, defects,
             failed, open, extremes, triangles_in_contact)
ASSAY_FIELDS(SelfTestRow, family, queries, contacts, contradictions, open, complete)
ASSAY_FIELDS(SpeedFigure, name, median, lo, hi, samples)
ASSAY_FIELDS(Issued, at, seconds)

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
  auto fields = fields_of(row);
  if constexpr (has_shard<T>) fields.emplace("shard", row.shard);
  try {
    read_fields(fields, x);
  } catch (const nlohmann::json::exception& wrong) {
    throw_not_stored(row, wrong);
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
        auto fields = json_of_fields<nlohmann::json>(x);
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
                repeated, search, inputs, corpus, self_test, speed, issued))
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
