#include "properties/campaign/ledger/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {

namespace {

// Throws StoreProblem if the row differs from to_row of its fields: its key or its progress then
// belong to other fields.
template <class T>
T fact_of(const Row& row) {
  T x;
  read_fields_of(row, x);
  if (to_row(x) != row)
    throw StoreProblem(fmt::format("{}: no run writes such a row", row_name(row)));
  return x;
}

// Adds the evidence in the row to the list, or sets the only one, if the row is of its kind.
template <class Place>
bool takes(Place& place, const Row& row) {
  using T = typename Place::value_type;
  if (row.kind != T::kind) return false;
  if constexpr (requires { place.push_back(T()); }) {
    place.push_back(fact_of<T>(row));
  } else {
    place = fact_of<T>(row);
  }
  return true;
}

template <class... T>
bool is_of_kind_that_may_differ(const Row& row, const std::variant<T...>*) {
  return ((row.kind == T::kind && requires { T::may_differ; }) || ...);
}

}  // namespace

bool FaultProof::is_found() const { return curated || found_at_random(); }

bool FaultProof::found_at_random() const {
  return std::ranges::any_of(needed, [](const auto& n) { return n.has_value(); });
}

bool FaultProof::is_whole(const CampaignPlan& plan) const {
  return !time_over && cases >= plan.fault_cases &&
         needed.size() >= static_cast<std::size_t>(plan.fault_seeds);
}

std::optional<std::uint64_t> FaultProof::median() const {
  if (needed.empty()) return std::nullopt;
  auto ascending = needed;
  std::ranges::sort(ascending, [](const auto& a, const auto& b) { return a && (!b || *a < *b); });
  return ascending[(ascending.size() - 1) / 2];
}

void FaultProof::add(const FaultProof& other) {
  needed.resize(std::max(needed.size(), other.needed.size()));
  for (std::size_t seed = 0; seed < other.needed.size(); ++seed) {
    if (!needed[seed] && other.needed[seed]) needed[seed] = cases + *other.needed[seed];
  }
  cases += other.cases;
  curated |= other.curated;
  time_over |= other.time_over;
}

std::uint64_t FaultProof::progress() const {
  const auto place = std::ranges::count_if(needed, [](const auto& n) { return n.has_value(); });
  return time_over ? static_cast<std::uint64_t>(place) : needed.size() + 1;
}

std::uint64_t World::progress() const {
  constexpr std::uint64_t farthest = std::numeric_limits<std::int64_t>::max();
  return counterexample ? farthest : classes;
}

Row to_row(const AnyEvidence& evidence) {
  return std::visit(
      []<class T>(const T& x) {
        Row row{T::kind, "", 1, corpus::json_text(json_of_fields<nlohmann::json>(x))};
        if constexpr (requires { x.key(); }) row.key = x.key();
        if constexpr (requires { x.progress(); }) row.progress = x.progress();
        return row;
      },
      evidence);
}

void EvidenceFacts::take(const Row& row) {
  const auto is_taken = [&](auto&... lists) { return (takes(lists, row) || ...); };
  if (!is_taken(canaries, problems, faults, power, worlds, request, versions, isolation, sources,
                speed, issued))
    throw StoreProblem(fmt::format("no run stores {}", row_name(row)));
}

namespace {

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

template <class T>
void append_new(std::vector<T>& list, const std::vector<T>& more) {
  for (const auto& x : more) {
    const Row row = to_row(x);
    if (std::ranges::none_of(list, [&](const T& y) { return to_row(y) == row; })) list.push_back(x);
  }
}

// Merges evidence that must be the same in all runs of one campaign.
template <class T>
void join(std::optional<T>& only, const std::optional<T>& other) {
  if (only && other && to_row(*only) != to_row(*other))
    throw StoreProblem(fmt::format("two runs have different rows of kind {}", T::kind));
  if (!only) only = other;
}

// Merges two lists. If both have an item of one key, `meet` merges the second item into the first.
template <class T, class Meet>
void merge(std::vector<T>& list, const std::vector<T>& more, const Meet& meet) {
  for (const auto& one : more) {
    const auto place = std::ranges::find(list, one.key(), &T::key);
    place == list.end() ? list.push_back(one) : meet(*place, one);
  }
}

}  // namespace

void EvidenceFacts::add(EvidenceFacts other) {
  // If a run planted the faults by itself, its proof is taken, and not the proofs that other runs
  // took over: those may be the same proof, and its cases would then count twice.
  const auto planted_count = [](const auto& facts) {
    return facts.power.empty() && !facts.faults.empty();
  };
  if (planted_count(other) && !power.empty()) {
    faults.clear();
    power.clear();
  }
  if (!planted_count(*this) || other.power.empty()) {
    const bool are_taken_over = !power.empty() && !other.power.empty();
    merge(faults, other.faults, [&](FaultProof& stored_proof, const FaultProof& proof) {
      if (!are_taken_over) {
        stored_proof.add(proof);
      } else if (to_row(stored_proof) != to_row(proof)) {
        throw StoreProblem(fmt::format("two runs took over different proofs for {}", proof.fault));
      }
    });
    append_new(power, other.power);
  }
  if (power.size() > 1)
    throw StoreProblem("two runs took over proofs of planted faults from different runs");
  // A world is the same in every run, so only the proof that came farthest counts.
  merge(worlds, other.worlds, [](World& stored_world, const World& world) {
    if (stored_world.progress() < world.progress()) stored_world = world;
  });
  for (const auto& row : other.sources) {
    row_of(row.source).is_drawn ? sources.push_back(row) : append_new(sources, {row});
  }
  append(canaries, other.canaries);
  append(problems, other.problems);
  append(isolation, other.isolation);
  append(speed, other.speed);
  join(request, other.request);
  join(versions, other.versions);
  if (!issued) {
    issued = other.issued;
  } else if (other.issued) {
    issued->at = std::max(issued->at, other.issued->at);
    issued->seconds += other.issued->seconds;
  }
}

std::vector<JudgedSource> EvidenceFacts::rows_of(Source source) const {
  auto rows = sources;
  std::erase_if(rows, [&](const JudgedSource& row) {
    return row.source != source && row_of(row.source).counts_as != source;
  });
  return rows;
}

JudgedSource EvidenceFacts::sum_of(Source source) const {
  JudgedSource sum{.source = source};
  for (const auto& row : rows_of(source)) {
    for (const auto count : {&JudgedSource::planned, &JudgedSource::cases, &JudgedSource::steps,
                             &JudgedSource::defects, &JudgedSource::undecided})
      sum.*count += row.*count;
    sum.triangles = std::max(sum.triangles, row.triangles);
    sum.complete &= row.complete;
    sum.causes.insert(row.causes.begin(), row.causes.end());
  }
  return sum;
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
