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

template <class T>
void append(std::vector<T>& list, const T& item) {
  if (list.size() == list.capacity()) list.reserve(with_room(list.size()));
  list.push_back(item);
}

}  // namespace

void PairContacts::make_room() {
  settle();
  // With less than a fifth of it free there would be too much sorting.
  if (all_.capacity() < with_room(all_.size())) all_.reserve(with_room(all_.size()));
}

// The late ones are sorted, those of pairs that are settled taken in there, the others merged.
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
      append(new_, next->pair);
      *kept++ = *next;
    } else if (is_before(*next, *place)) {
      *place = *next;
    }
  }
  all_.erase(kept, all_.end());
  std::inplace_merge(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(settled_), all_.end(),
                     is_before);
  settled_ = all_.size();
}

std::vector<TrianglePair> PairContacts::take_new_pairs() {
  settle();
  return std::exchange(new_, {});
}

std::vector<PairContact> PairContacts::take() {
  settle();
  settled_ = 0;
  new_ = {};
  return std::exchange(all_, {});
}

}  // namespace assay::detector
