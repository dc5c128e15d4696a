// The rounds of a search that looks for the first contact.
//
// What is found in one round bounds the next: contacts later than the earliest one so far are of
// no interest, so boxes need to cover only the time up to it. A round is a share of the pairs of
// nodes that the descent was cut into. They are taken in an order that spreads each round over the
// whole mesh, because contacts mostly lie side by side. Neither rounds nor order depend on the
// number of workers, so neither do candidates and counts.
#pragma once

#include <bit>
#include <span>
#include <vector>

#include "detector/search/pair_search.h"

namespace assay::detector {

// How many pairs of nodes such a search is cut into, if it does not end before that.
inline constexpr std::size_t pairs_in_rounds = 512;

// The same items in the order of their numbers with the bits reversed.
template <class Item>
std::vector<Item> spread_out(const std::vector<Item>& items) {
  std::vector<Item> spread;
  spread.reserve(items.size());
  const std::size_t count = std::bit_ceil(items.size());
  std::size_t reversed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (reversed < items.size()) spread.push_back(items[reversed]);
    // Adds one to the reversed number: the carry runs from the highest bit down.
    std::size_t bit = count / 2;
    for (; reversed & bit; bit /= 2) reversed ^= bit;
    reversed |= bit;
  }
  return spread;
}

// Calls run(span of pairs) for one round after the other, and input.between() between two of them.
// False if one of them returned false. REQUIRES input.between, and that run() has given all that it
// found to the sink when it returns.
template <class NodePair, class Run>
bool run_in_rounds(const SearchInput& input, const std::vector<NodePair>& pairs, Run run) {
  const std::vector<NodePair> order = spread_out(pairs);
  const auto left = std::span(order);
  // In 64ths of the pairs. A round costs a refit at most, which is a few percent of the search.
  constexpr std::size_t ends[] = {1, 4, 16, 32, 64};
  std::size_t begin = 0;
  for (const std::size_t part : ends) {
    const std::size_t end = (part * order.size() + 63) / 64;
    if (begin > 0 && begin < end && !input.between()) return false;
    if (begin < end && !run(left.subspan(begin, end - begin))) return false;
    begin = end;
  }
  return true;
}

}  // namespace assay::detector
