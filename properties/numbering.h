// Lists of the numbers of vertices or triangles: in order, shuffled, exchanged.
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "detector/mesh/step_types.h"
#include "properties/random.h"

namespace assay::properties {

using Numbers = std::vector<std::int32_t>;

using detector::at;

// 0 .. count - 1.
inline Numbers in_order(std::size_t count) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// By Fisher and Yates.
template <class List>
List shuffled(Random& random, List list) {
  for (std::size_t i = list.size(); i > 1; --i) {
    std::swap(list[i - 1], list[at(random.below(static_cast<int>(i)))]);
  }
  return list;
}

// The pairs after triangle t has become new_number[t], sorted.
inline std::vector<detector::PairContact> renumbered(std::vector<detector::PairContact> pairs,
                                                     std::span<const std::int32_t> new_number) {
  for (auto& [pair, time, feature] : pairs) {
    const auto a = new_number[at(pair.a)], b = new_number[at(pair.b)];
    pair = {std::min(a, b), std::max(a, b)};
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a.pair < b.pair; });
  return pairs;
}

}  // namespace assay::properties
