// Sorts items by a key that is a small number, such as the number of a vertex. A stop function can
// end it.
//
// It is a counting sort: two passes over the items, however many there are. To sort by two keys,
// sort by the less important key first, then by the other.
#pragma once

#include <utility>
#include <vector>

#include "detector/mesh/paced_stop.h"

namespace assay::detector {

// Sorts `items`; items with equal keys stay in their order. REQUIRES key(item) < keys for each
// item. `room` is working memory, which can be handed to the next sort. False if the pace was
// stopped: then the items are of no use.
template <class Item, class Key>
bool sort_by_key(std::vector<Item>& items, std::vector<Item>& room, std::size_t keys, Key key,
                 PacedStop& pace) {
  constexpr std::uint64_t work_to_count = 1, work_to_place = 2;
  std::vector<std::uint32_t> next(keys + 1, 0);
  const auto count = [&](std::size_t i) { ++next[static_cast<std::size_t>(key(items[i])) + 1]; };
  if (!for_each_paced(items.size(), work_to_count, pace, count)) return false;
  const auto add = [&](std::size_t k) { next[k + 1] += next[k]; };
  if (!for_each_paced(keys, work_to_count, pace, add)) return false;
  room.resize(items.size());
  const auto place = [&](std::size_t i) {
    room[next[static_cast<std::size_t>(key(items[i]))]++] = items[i];
  };
  if (!for_each_paced(items.size(), work_to_place, pace, place)) return false;
  std::swap(items, room);
  return true;
}

}  // namespace assay::detector
