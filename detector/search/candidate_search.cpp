#include "detector/search/candidate_search.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

CandidateSearch::CandidateSearch(const SearchStages& stages, const Topology& mesh,
                                 const BoundingVolumeTree& tree, const PositionsView& x_t0,
                                 const PositionsView& x_t1, const std::vector<std::uint8_t>& clean,
                                 std::vector<std::uint8_t> triangle_flags, const StopFunction& stop)
    : stages_(stages),
      mesh_(mesh),
      tree_(tree),
      clean_(clean),
      stop_(stop),
      contacts_(mesh, x_t0, x_t1, stages.elementary, Want::first_time) {
  marks_.triangle_flags = std::move(triangle_flags);
}

bool CandidateSearch::same_component(std::int32_t a, std::int32_t b) const {
  return mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
}

bool CandidateSearch::collect(const PairTables& tables) {
  const auto sink = [&](std::int32_t a, std::int32_t b) {
    constexpr std::uint64_t pairs_between_stops = 4096;
    if (counts_.candidate_pairs % pairs_between_stops == 0 && stop_ && stop_()) return false;
    // A clean triangle is in no contact with its own component at t=0.
    const bool may_pierce = !same_component(a, b) || (!clean_[at(a)] && !clean_[at(b)]);
    contacts_.add_candidate(a, b, may_pierce);
    return true;
  };
  return stages_.search.search({mesh_, tree_, marks_, tables}, counts_, sink);
}

bool CandidateSearch::close() {
  std::vector<std::uint8_t> in_h(mesh_.triangles.size(), 0);
  const PairTables tables = stages_.rule.closure();
  std::size_t seen = 0;
  while (true) {
    bool grew = false;
    for (auto& flags : marks_.triangle_flags) flags &= static_cast<std::uint8_t>(~flag::grown);
    for (; seen < contacts_.contacts().size(); ++seen) {
      for (const auto& pair : contacts_.contacts()[seen].pairs) {
        if (!same_component(pair.a, pair.b)) continue;
        for (const auto t : {pair.a, pair.b}) {
          if (in_h[at(t)] || !stages_.rule.joins_closure(pair, t)) continue;
          in_h[at(t)] = 1;
          if (marks_.triangle_flags[at(t)] & (flag::zero | flag::violated)) continue;
          marks_.triangle_flags[at(t)] |= flag::grown;
          grew = true;
        }
      }
    }
    if (!grew) return true;
    ++closure_rounds_;
    if (!collect(tables) || !test()) return false;
  }
}

}  // namespace assay::detector
