#include "detector/search/candidate_search.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "detector/boxes/moving_box.h"
#include "detector/mesh/for_all.h"
#include "detector/parallel/workers.h"

namespace assay::detector {
CandidateSearch::CandidateSearch(const SearchStages& stages, const Topology& mesh,
                                 const BoundingVolumeTree& tree, SearchMemory& memory,
                                 const SteppedMesh& motion, const PacedStop& pace)
    : stages_(stages),
      mesh_(mesh),
      tree_(tree),
      memory_(memory),
      motion_(motion),
      stop_(pace.stop()),
      pace_(pace),
      contacts_(mesh, motion, stages.elementary, Want::first_time, memory.representatives,
                memory.marks.types) {
  contacts_.sort_by(stages.relation);
  if (pace.workers()) contacts_.make_lanes(pace.workers()->count());
}

bool CandidateSearch::mark(std::span<const TriangleType> types) {
  if (pace_.stopped()) return false;
  if (!memory_.is_whole) {
    memory_.marks = Marks(tree_);
    memory_.representatives = Representatives();
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
  if (!changed.empty()) memory_.near.forget();
  if (pace_.after(work_of_mark * changed.size())) return false;
  return memory_.is_whole = memory_.representatives.update(mesh_, types, changed, &pace_);
}

bool CandidateSearch::same_component(std::int32_t a, std::int32_t b) const {
  return mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
}

double CandidateSearch::share_of_edges(bool open_alone) const {
  constexpr std::size_t most_edges = 512;
  const PairTables k = stages_.rule.candidates();
  const std::size_t edges = std::min(mesh_.edges.size(), most_edges);
  // If all triangles have the same flag, the rule asks for all of these pairs or for none.
  const bool one_is_enough =
      !open_alone && std::has_single_bit(memory_.marks.node_flags[BoundingVolumeTree::root]);
  std::size_t candidates = 0, pairs = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    const auto holders =
        mesh_.edge_triangles.row(static_cast<std::int32_t>(i * mesh_.edges.size() / edges));
    if (holders.size() < 2) continue;
    ++pairs;
    candidates += k.within.asks(memory_.marks.flags(holders[0]), memory_.marks.flags(holders[1])) &&
                  !(open_alone && contacts_.are_proved_apart(holders[0], holders[1]));
    if (one_is_enough) break;
  }
  return pairs == 0 ? 0 : static_cast<double>(candidates) / static_cast<double>(pairs);
}

// For a thousand triangles, fans cost as much as a few hundred of the pairs that they leave out.
void CandidateSearch::prove_apart() {
  constexpr double least_asked = 0.125;
  if (std::exchange(has_proved_apart_, true) || asked_share() < least_asked) return;
  contacts_.ask(AskedTypes::in_first_search(stages_.rule.candidates()));
  contacts_.prove_apart(tree_.wide(), &pace_, [&] { fit_features(); });
}

void CandidateSearch::fit_features() {
  // Features have a margin where boxes have one.
  const double slack = tree_.grown_by() > 0 ? FloatGrid::least_distance : 0;
  if (!std::exchange(has_features_, true)) contacts_.take_near_in(motion_, slack, &pace_);
}

void CandidateSearch::look_for_first(const TimeBound& bound, BoundingVolumeTree& tree) {
  first_.emplace(First{bound, tree, bound.until});
  contacts_.leave_out_later_than(bound);
}

void CandidateSearch::take_earliest() {
  first_->bound.until = std::min(first_->bound.until, contacts_.least_end());
  contacts_.leave_out_later_than(first_->bound);
}

bool CandidateSearch::tighten() {
  auto& [bound, tree, asked_until, fitted] = *first_;
  take_earliest();
  // If times are not unique, a pair that doubles cannot tell from a contact is found only if it is
  // tested. So the tested pairs must not depend on which contact was found before.
  const double useful = bound.has_unique_times ? bound.until : asked_until;
  // A refit costs a few percent of the search, so it has to save about as much.
  if (useful > fitted / 2 || useful == fitted) return true;
  const ShortenedStep shortened(motion_, useful, pace_);
  if (pace_.stopped() || !tree.refit(mesh_, shortened.motion(), pace_, shortened.slack()))
    return false;
  contacts_.take_near_in(shortened.motion(), shortened.slack(), &pace_);
  has_features_ = true;
  fitted = useful;
  return !pace_.stopped();
}

bool CandidateSearch::search(const PairTables& tables, bool uses_proofs) {
  const auto& types = memory_.marks.types;
  if (!contacts_.find_few()) {
    memory_.is_whole = false;  // it stays false if memory runs out
    if (!memory_.representatives.make(mesh_, types, &pace_)) return false;
    memory_.is_whole = true;
  }
  if (first_ && !tighten()) return false;
  struct alignas(64) Asking {
    std::size_t pairs_until = 0;
  };
  std::vector<Asking> asking(pace_.workers() ? pace_.workers()->count() : 1);
  const auto take = [&](std::span<const CandidatePair> pairs, std::size_t lane) {
    constexpr std::size_t pairs_between_stops = 4096;
    auto& until = asking[lane].pairs_until;
    if (until < pairs.size()) {
      if (stop_ && stop_()) return false;
      until = pairs_between_stops;
    }
    until -= std::min(until, pairs.size());
    for (const auto& [a, b] : pairs) {
      if (contacts_.are_proved_apart(a, b)) continue;
      if (!has_features_) fit_features();
      // A clean triangle is in no contact with its own component at t=0.
      const bool may_pierce =
          (types[at(a)] == TriangleType::dirty && types[at(b)] == TriangleType::dirty) ||
          !same_component(a, b);
      if (!contacts_.add_candidate(a, b, may_pierce, stop_, lane)) return false;
    }
    return true;
  };
  SearchInput input = {mesh_,  tree_,       memory_.marks,    tables,
                       &pace_, uses_proofs, stages_.relation, contacts_.sheets()};
  if (first_) input.between = [&] { return contacts_.run(stop_, &pace_) && tighten(); };
  return stages_.search.search(input, counts_, PairSink::in_lanes(take)) &&
         contacts_.run(stop_, &pace_);
}

bool CandidateSearch::collect(bool uses_proofs, bool keeps) {
  if (first_) {
    first_->bound.until = first_->asked_until;
    contacts_.leave_out_later_than(first_->bound);
  }
  const PairTables k = stages_.rule.candidates();
  contacts_.ask(AskedTypes::in_first_search(k));
  const bool has_proofs = uses_proofs && stages_.search.has_proofs();
  // Proofs of patches leave out the same pairs.
  if (!has_proofs) prove_apart();
  // Where sheets leave few pairs or none, features are fitted for the first pair that comes.
  if (!contacts_.find_few() || has_workers(&pace_)) fit_features();
  memory_.near.forget();
  keeps = keeps && !has_proofs && !motion_.is_at_rest();
  if (keeps) contacts_.list_keys(KeptFeatures::most_features(mesh_), memory_.near.take_room());
  if (pace_.stopped() || !search(k, uses_proofs)) return false;
  const double until = first_ ? first_->fitted : 1;
  if (!keeps || until == 0) return true;
  if (auto keys = contacts_.take_keys())
    memory_.near.keep(motion_, until, contacts_.grid(), std::move(*keys), pace_);
  return !pace_.stopped();
}

bool CandidateSearch::collect_kept() {
  kept_until_ = memory_.near.covered_until(motion_, pace_);
  if (pace_.stopped()) return false;
  if (kept_until_ < asked_until()) {
    if (!first_ || kept_until_ == 0) return true;
    first_->bound.until = kept_until_;
    contacts_.leave_out_later_than(first_->bound);
  }
  for (std::size_t i = 0; i < KeptFeatures::parts; ++i) {
    if (first_) take_earliest();
    if (!contacts_.run(memory_.near.part(i), stop_, &pace_)) return false;
  }
  return true;
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
    // The counts of marking depend on the order, and the order found depends on the lanes.
    std::sort(grown.begin(), grown.end(),
              [](const auto& x, const auto& y) { return x.triangle < y.triangle; });
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
