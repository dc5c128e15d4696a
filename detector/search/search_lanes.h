// Divides the descent of a search into lanes, and into rounds if it looks for the first contact.
//
// A descent is cut into pairs of nodes near the root, and each worker does one such pair after the
// other. The work for a pair of nodes does not depend on other pairs.
//
// The contacts of a round shorten the next round: contacts later than the earliest contact so far
// are not needed, so boxes have to cover only the time up to that contact. A round does some of the
// pairs of nodes into which the descent was cut. Each round has pairs from the whole mesh, because
// contacts mostly lie close together. Rounds and their order do not depend on the number of
// workers, so candidates and counts do not depend on this number.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <span>
#include <vector>

#include "detector/mesh/for_all.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// The data that the lanes of a descent share.
struct Hunt {
  Hunt(const SearchInput& searched, const PairSink& taker)
      : input(searched),
        flags(searched.marks.node_flags.data()),
        within(searched.tables.within),
        across(searched.tables.across),
        either(within.joined_with(across)),
        sink(taker) {}

  // Returns the table for pairs of the components c and d; it is empty if these are not searched.
  // REQUIRES that neither is mixed_components.
  const PairTable& table_of(std::int32_t c, std::int32_t d) const {
    if (!input.components_meet(c, d)) return nothing;
    return c == d ? within : across;
  }

  const SearchInput& input;
  const std::uint8_t* const flags;  // by binary node
  const PairTable within, across, either, nothing = {};
  const PairSink& sink;
  std::atomic<bool> is_stopped = false;
};

// The candidates that one lane has found and not yet given to the sink.
class FoundPairs {
 public:
  // Two wide nodes have up to 64 pairs of children. There is room for so many more pairs, so
  // are_enough() needs to be called only after each pair of nodes, not after each add().
  FoundPairs(Hunt& hunt, std::size_t lane)
      : hunt_(hunt),
        lane_(lane),
        found_(std::make_unique_for_overwrite<CandidatePair[]>(at_once + 64)) {}
  void add(std::int32_t a, std::int32_t b) { found_[size_++] = {a, b}; }
  std::size_t size() const { return size_; }
  bool are_enough() const { return size_ >= at_once; }
  void hand_over(bool is_ended) {
    const std::span<const CandidatePair> found(found_.get(), size_);
    if (!found.empty() && !is_ended && !hunt_.sink(found, lane_)) hunt_.is_stopped = true;
    size_ = 0;
  }

 private:
  static constexpr std::size_t at_once = 256;
  Hunt& hunt_;
  const std::size_t lane_;
  std::size_t size_ = 0;
  const std::unique_ptr<CandidatePair[]> found_;
};

// Cuts the descent below the pairs of nodes `left` into `count` pairs of nodes or a few more; the
// highest pairs are split first. If the descent ends earlier, the result has fewer pairs.
// split(pair, out) appends the pairs below `pair` to `out`.
template <class NodePair, class Split, class IsEnded>
std::vector<NodePair> cut_below(std::vector<NodePair> left, std::size_t count, Split split,
                                IsEnded is_ended) {
  std::vector<NodePair> below;
  for (std::size_t first = 0;; ++first) {
    if (first == left.size() || left.size() - first >= count || is_ended()) {
      left.erase(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(first));
      return left;
    }
    below.clear();
    split(left[first], below);
    left.insert(left.end(), below.begin(), below.end());
  }
}

// The number of pairs of nodes into which a search in rounds is cut; fewer if the descent ends
// earlier.
inline constexpr std::size_t pairs_in_rounds = 512;

// Returns the numbers below `count`, ordered by their reversed bits.
inline std::vector<std::size_t> spread_numbers(std::size_t count) {
  std::vector<std::size_t> spread;
  spread.reserve(count);
  const std::size_t beyond = std::bit_ceil(count);
  std::size_t reversed = 0;
  for (std::size_t i = 0; i < beyond; ++i) {
    if (reversed < count) spread.push_back(reversed);
    // Adds one to the reversed number: the carry runs from the highest bit down.
    std::size_t bit = beyond / 2;
    for (; reversed & bit; bit /= 2) reversed ^= bit;
    reversed |= bit;
  }
  return spread;
}

// Calls run(span of pairs) for one round after the other, and input.between() between two rounds.
// Returns false if a call returned false. REQUIRES that input.between is not empty, and that run()
// gives all candidates that it finds to the sink before it returns. Within a round the pairs keep
// their order, because neighbours read the same data, which are then in the caches.
template <class NodePair, class Run>
bool run_in_rounds(const SearchInput& input, const std::vector<NodePair>& pairs, Run run) {
  std::vector<std::size_t> numbers = spread_numbers(pairs.size());
  std::vector<NodePair> round;
  // The ends of the rounds, in 64ths of the pairs.
  constexpr std::size_t ends[] = {1, 4, 16, 32, 64};
  std::size_t begin = 0;
  for (const std::size_t part : ends) {
    const std::size_t end = (part * numbers.size() + 63) / 64;
    if (begin == end) continue;
    if (begin > 0 && !input.between()) return false;
    const auto of_round = std::span(numbers).subspan(begin, end - begin);
    std::sort(of_round.begin(), of_round.end());
    round.clear();
    for (const auto n : of_round) round.push_back(pairs[n]);
    if (!run(std::span<const NodePair>(round))) return false;
    begin = end;
  }
  return true;
}

// Runs a descent. `descent` has three functions: cut(count) cuts it into `count` pairs of nodes or
// a few more (fewer if it ends earlier); run(pair) does one of these pairs; and finish() gives the
// last candidates to the sink and returns whether the search goes on. make_lane(index) makes a lane
// that has its own descent and its own counts. Returns false if the search was stopped.
template <class Descent, class MakeLane>
bool run_descent(const SearchInput& input, bool takes_lanes, Descent& descent, SearchCounts& counts,
                 MakeLane make_lane) {
  // With this many pairs of nodes for each lane, all lanes have about the same amount of work.
  constexpr std::size_t pairs_of_lane = 64;
  const bool has_lanes = takes_lanes && has_workers(input.pace);
  const std::size_t count = input.between ? pairs_in_rounds
                            : has_lanes   ? pairs_of_lane * input.pace->workers()->count()
                                          : 1;
  const auto pairs = descent.cut(count);
  if (!descent.finish()) return false;
  std::vector<decltype(make_lane(std::size_t{0}))> lanes;
  if (has_lanes && pairs.size() >= count) {
    for (std::size_t i = 0; i < input.pace->workers()->count(); ++i) lanes.push_back(make_lane(i));
  }
  const auto run = [&](const auto& some) {
    if (lanes.empty()) {
      for (const auto& pair : some) descent.run(pair);
      return descent.finish();
    }
    input.pace->workers()->share_out(some.size(), 1, [&](const LoopPiece& piece) {
      lanes[piece.lane]->descent.run(some[piece.begin]);
    });
    bool completed = true;
    for (const auto& lane : lanes) completed = lane->descent.finish() && completed;
    return completed;
  };
  const bool completed = input.between ? run_in_rounds(input, pairs, run) : run(pairs);
  for (const auto& lane : lanes) counts += lane->counts;
  return completed;
}

}  // namespace assay::detector
