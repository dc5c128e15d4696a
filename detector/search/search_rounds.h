// The rounds of a search that looks for the first contact.
//
// What is found in one round bounds the next: contacts later than the earliest one so far are of
// no interest, so boxes need to cover only the time up to it. A round is a share of the pairs of
// nodes that the descent was cut into. They are taken in an order that spreads each round over the
// whole mesh, because contacts mostly lie side by side. Neither rounds nor order depend on the
// number of workers, so neither do candidates and counts.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "detector/search/pair_search.h"

namespace assay::detector {

// How many pairs of nodes such a search is cut into, if it does not end before that.
inline constexpr std::size_t pairs_in_rounds = 512;

// The numbers below `count`, ordered by their bits reversed.
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

// Calls run(span of pairs) for one round after the other, and input.between() between two of them.
// False if one of them returned false. REQUIRES input.between, and that run() has given all that it
// found to the sink when it returns. Within a round the pairs keep their order, because neighbours
// find what they read in the caches.
template <class NodePair, class Run>
bool run_in_rounds(const SearchInput& input, const std::vector<NodePair>& pairs, Run run) {
  std::vector<std::size_t> numbers = spread_numbers(pairs.size());
  std::vector<NodePair> round;
  // In 64ths of the pairs.
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

}  // namespace assay::detector
