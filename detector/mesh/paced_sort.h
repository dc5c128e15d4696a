// Sorts by a key that is a small number, such as that of a vertex, and can be ended in between.
//
// By counting: two passes over the items, however large they are. Twice, by the lesser of two keys
// first, it sorts by both.
#pragma once

#include <utility>
#include <vector>

#include "detector/mesh/paced_stop.h"

namespace assay::detector {

// Items of equal key stay in their order; keys are below `keys`. `room` is what is worked in: hand
// it to the next sort. False when it was ended in between: the items are then of no use.
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
