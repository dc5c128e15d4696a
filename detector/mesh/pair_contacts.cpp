#include "detector/mesh/pair_contacts.h"

#include <algorithm>
#include <utility>

namespace assay::detector {
namespace {

bool is_before(const PairContact& x, const PairContact& y) {
  if (x.pair != y.pair) return x.pair < y.pair;
  if (x.time != y.time) return x.time < y.time;
  if (x.feature.kind != y.feature.kind) return x.feature.kind < y.feature.kind;
  return x.feature.vertices < y.feature.vertices;
}

constexpr std::size_t least_room = 1024;

std::size_t with_room(std::size_t size) { return size + std::max(size / 4, least_room); }

}  // namespace

bool PairContacts::make_room(const StopFunction& stop) {
  settle();
  // If less than a fifth of it is free the list grows. Else it would be sorted too often.
  const std::size_t wanted = with_room(all_.size());
  if (all_.capacity() >= wanted) return true;
  constexpr std::size_t at_once = 16'384;  // 768 KB
  std::vector<PairContact> larger;
  larger.reserve(wanted);
  for (auto next = all_.begin(); next != all_.end();) {
    const auto end = next + std::min<std::ptrdiff_t>(at_once, all_.end() - next);
    larger.insert(larger.end(), next, end);
    next = end;
    if (stop && stop()) return false;
  }
  std::swap(all_, larger);
  return true;
}

// Sorts the late contacts. One whose pair is settled replaces the settled contact if it is
// earlier; the others are merged in as new pairs.
void PairContacts::settle() {
  const auto late = all_.begin() + static_cast<std::ptrdiff_t>(settled_);
  std::sort(late, all_.end(), is_before);
  auto kept = late;
  auto place = all_.begin();
  for (auto next = late; next != all_.end(); ++next) {
    if (kept != late && std::prev(kept)->pair == next->pair) continue;
    place = std::lower_bound(place, late, next->pair,
                             [](const PairContact& x, TrianglePair pair) { return x.pair < pair; });
    if (place == late || place->pair != next->pair) {
      new_.push_back(next->pair);
      *kept++ = *next;
    } else if (is_before(*next, *place)) {
      *place = *next;
    }
  }
  all_.erase(kept, all_.end());
  merge_late(all_.size() - settled_);
  settled_ = all_.size();
}

// Merges the last `count` contacts into the settled ones. They are copied aside, and the merge
// fills the list from its end, so it needs no room but theirs.
void PairContacts::merge_late(std::size_t count) {
  if (late_.capacity() < count) {
    late_ = {};
    late_.reserve(with_room(count));
  }
  late_.assign(all_.end() - static_cast<std::ptrdiff_t>(count), all_.end());
  auto place = all_.end();
  auto settled = all_.begin() + static_cast<std::ptrdiff_t>(settled_);
  for (auto late = late_.end(); late != late_.begin();) {
    const bool is_later =
        settled != all_.begin() && is_before(*std::prev(late), *std::prev(settled));
    *--place = is_later ? *--settled : *--late;
  }
}

std::deque<TrianglePair> PairContacts::take_new_pairs() {
  settle();
  return std::exchange(new_, {});
}

std::vector<PairContact> PairContacts::take() {
  settle();
  settled_ = 0;
  new_ = {};
  late_ = {};
  return std::exchange(all_, {});
}

}  // namespace assay::detector
