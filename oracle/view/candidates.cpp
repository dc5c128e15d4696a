#include "oracle/view/candidates.h"

#include <algorithm>
#include <cassert>

namespace assay::oracle {

using detector::PairContact;
using detector::TrianglePair;
using detector::ViewSign;

Candidates::Candidates(std::vector<ViewSign> signs, std::vector<std::uint8_t> violated,
                       std::vector<std::int32_t> groups)
    : signs_(std::move(signs)), violated_(std::move(violated)), groups_(std::move(groups)) {
  assert(violated_.empty() || violated_.size() == signs_.size());
  assert(groups_.empty() || groups_.size() == signs_.size());
}

bool Candidates::holds(const TrianglePair& pair) const {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  if (signs_[a] == ViewSign::zero || signs_[b] == ViewSign::zero) return true;
  if (signs_[a] != signs_[b]) return true;
  if (!violated_.empty() && (violated_[a] || violated_[b])) return true;
  return !groups_.empty() && groups_[a] != groups_[b];
}

PairSplit split(const std::vector<PairContact>& pairs, const Candidates& candidates) {
  PairSplit parts;
  for (const PairContact& contact : pairs) {
    (candidates.holds(contact.pair) ? parts.in_k : parts.outside).push_back(contact);
  }
  return parts;
}

bool holds_a_first_contact(const std::vector<PairContact>& pairs, const Candidates& candidates) {
  const auto first = std::min_element(pairs.begin(), pairs.end(),
                                      [](const auto& x, const auto& y) { return x.time < y.time; });
  return first == pairs.end() ||
         std::any_of(pairs.begin(), pairs.end(), [&](const PairContact& contact) {
           return contact.time == first->time && candidates.holds(contact.pair);
         });
}

}  // namespace assay::oracle
