#include "detector/search/candidate_search.h"

namespace assay::detector {
CandidateSearch::CandidateSearch(const SearchStages& stages, const Topology& mesh,
                                 const BoundingVolumeTree& tree, SearchMemory& memory,
                                 const PositionsView& x_t0, const PositionsView& x_t1,
                                 const StopFunction& stop)
    : stages_(stages),
      mesh_(mesh),
      tree_(tree),
      memory_(memory),
      x_t0_(x_t0),
      x_t1_(x_t1),
      stop_(stop),
      pace_(stop),
      contacts_(mesh, x_t0, x_t1, stages.elementary, Want::first_time, memory.representatives,
                memory.marks.types, &pace_) {}

bool CandidateSearch::mark(std::span<const TriangleType> types) {
  if (pace_.stopped()) return false;
  if (!memory_.is_whole) {
    memory_.marks = Marks(tree_);
    memory_.representatives = Representatives(mesh_, &pace_);
    if (pace_.stopped()) return false;
  }
  memory_.is_whole = false;
  stages_.marking.bring_to(types, tree_, memory_.marks, marking_counts_);
  return follow_marks();
}

bool CandidateSearch::change_types(std::span<const Marking::Change> changes) {
  memory_.is_whole = false;
  stages_.marking.change(changes, tree_, memory_.marks, marking_counts_);
  return follow_marks();
}

bool CandidateSearch::follow_marks() {
  constexpr std::uint64_t work_of_mark = 8;  // in box tests
  const auto& [types, flags, changed] = memory_.marks;
  if (pace_.after(work_of_mark * changed.size())) return false;
  return memory_.is_whole = memory_.representatives.update(mesh_, types, changed, &pace_);
}

bool CandidateSearch::same_component(std::int32_t a, std::int32_t b) const {
  return mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
}

SearchInput CandidateSearch::input(const PairTables& tables, bool uses_proofs) {
  return {mesh_,  tree_,  memory_.marks, tables,     memory_.kept.get(),
          &x_t0_, &x_t1_, &pace_,        uses_proofs};
}

double CandidateSearch::provable_share() {
  const PairTables none;
  return stages_.search.provable_share(input(none, true));
}

bool CandidateSearch::search(const PairTables& tables, bool uses_proofs) {
  const auto& types = memory_.marks.types;
  std::uint64_t pairs = 0;
  const auto sink = [&](std::int32_t a, std::int32_t b) {
    constexpr std::uint64_t pairs_between_stops = 4096;
    if (pairs++ % pairs_between_stops == 0 && stop_ && stop_()) return false;
    // A clean triangle is in no contact with its own component at t=0.
    const bool may_pierce =
        (types[at(a)] == TriangleType::dirty && types[at(b)] == TriangleType::dirty) ||
        !same_component(a, b);
    return contacts_.add_candidate(a, b, may_pierce, stop_);
  };
  return stages_.search.search(input(tables, uses_proofs), counts_, sink) && contacts_.run(stop_);
}

bool CandidateSearch::collect(bool uses_proofs) {
  const PairTables k = stages_.rule.candidates();
  contacts_.ask(AskedTypes::in_first_search(k));
  return search(k, uses_proofs);
}

bool CandidateSearch::close() {
  const PairTables tables = stages_.rule.closure();
  contacts_.ask(AskedTypes::in_closure(stages_.rule.candidates(), tables));
  std::vector<Marking::Change> grown;
  for (;;) {
    grown.clear();
    for (const auto& pair : contacts_.take_new_pairs()) {
      if (!same_component(pair.a, pair.b)) continue;
      for (const auto t : {pair.a, pair.b}) {
        const auto type = memory_.marks.types[at(t)];
        if (type != TriangleType::positive && type != TriangleType::negative) continue;
        if (!stages_.rule.joins_closure(pair, t)) continue;
        grown.push_back({t, type == TriangleType::positive ? TriangleType::positive_grown
                                                           : TriangleType::negative_grown});
      }
    }
    if (grown.empty()) return true;
    if (!change_types(grown)) return false;
    ++closure_rounds_;
    if (!search(tables, false)) return false;
    for (auto& [triangle, type] : grown) {
      type = type == TriangleType::positive_grown ? TriangleType::positive_joined
                                                  : TriangleType::negative_joined;
    }
    if (!change_types(grown)) return false;
  }
}

}  // namespace assay::detector
