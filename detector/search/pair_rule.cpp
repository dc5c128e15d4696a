#include "detector/search/pair_rule.h"

namespace assay::detector {

PairTable& PairTable::add(std::uint8_t a, std::uint8_t b) {
  partners_[a] |= b;
  partners_[b] |= a;
  update();
  return *this;
}

PairTable& PairTable::remove(std::uint8_t a, std::uint8_t b) {
  partners_[a] &= static_cast<std::uint8_t>(~b);
  partners_[b] &= static_cast<std::uint8_t>(~a);
  update();
  return *this;
}

// Makes the rows of unions of flags from the rows of single flags.
void PairTable::update() {
  for (std::size_t flags = 0; flags < unions; ++flags) {
    const std::size_t lowest = flags & (~flags + 1);
    if (lowest != flags) partners_[flags] = partners_[lowest] | partners_[flags ^ lowest];
  }
}

PairTable PairTable::joined_with(const PairTable& other) const {
  PairTable both = *this;
  for (std::size_t flags = 0; flags < unions; ++flags)
    both.partners_[flags] |= other.partners_[flags];
  return both;
}

PairTable PairTable::everything() {
  PairTable table;
  for (int a = 0; a < flag::count; ++a) table.partners_[std::size_t{1} << a] = unions - 1;
  table.update();
  return table;
}

PairTables PairRule::candidates() const {
  PairTable k;
  k.add(flag::positive, flag::negative);
  for (const auto u : {flag::positive, flag::negative, flag::zero, flag::violated}) {
    k.add(u, flag::zero).add(u, flag::violated);
  }
  return {k, PairTable::everything()};
}

PairTables PairRule::closure() const {
  PairTable grown;
  for (const auto u : {flag::positive, flag::negative, flag::zero, flag::violated}) {
    grown.add(u, flag::grown);
  }
  return {grown, {}};
}

bool PairRule::joins_closure(const TrianglePair&, std::int32_t) const { return true; }

PairTables EveryPair::candidates() const {
  return {PairTable::everything(), PairTable::everything()};
}

}  // namespace assay::detector
