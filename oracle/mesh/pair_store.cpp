#include "oracle/mesh/pair_store.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace assay::oracle {

namespace {

auto key(const detector::PairContact& c) {
  return std::tie(c.pair.a, c.pair.b, c.time.lo, c.time.hi, c.feature.kind, c.feature.vertices);
}

}  // namespace

void PairStore::add(std::int32_t a, std::int32_t b, const detector::TimeEnclosure& time,
                    const detector::Feature& feature) {
  contacts_.push_back({{std::min(a, b), std::max(a, b)}, time, feature});
  if (contacts_.size() >= tidy_at_) keep_least();
}

void PairStore::merge(PairStore& other) {
  contacts_.insert(contacts_.end(), other.contacts_.begin(), other.contacts_.end());
  other.contacts_ = {};
}

std::vector<detector::PairContact> PairStore::take() {
  keep_least();
  return std::exchange(contacts_, {});
}

void PairStore::keep_least() {
  std::sort(contacts_.begin(), contacts_.end(),
            [](const auto& x, const auto& y) { return key(x) < key(y); });
  contacts_.erase(std::unique(contacts_.begin(), contacts_.end(),
                              [](const auto& x, const auto& y) { return x.pair == y.pair; }),
                  contacts_.end());
  tidy_at_ = std::max(tidy_at_, 2 * contacts_.size());
}

}  // namespace assay::oracle
