#include "properties/claims/claims.h"

#include <algorithm>

#include "properties/words.h"

namespace assay::properties {

bool Claims::has(Claim claim) const {
  constexpr bool Claims::*in_order[] = {
      &Claims::free_sound,    &Claims::not_late,  &Claims::first_time,
      &Claims::first_pairs,   &Claims::all_pairs, &Claims::no_spurious,
      &Claims::deterministic, &Claims::total,     &Claims::candidates};
  return this->*in_order[static_cast<std::size_t>(claim)];
}

const char* name_of(Claim claim) {
  return word_of({"free-sound", "not-late", "first-time", "first-pairs", "all-pairs", "no-spurious",
                  "deterministic", "total", "candidates"},
                 claim);
}

const std::vector<Claim>& all_claims() {
  static const std::vector<Claim> all = {Claim::free_sound,    Claim::not_late,  Claim::first_time,
                                         Claim::first_pairs,   Claim::all_pairs, Claim::no_spurious,
                                         Claim::deterministic, Claim::total,     Claim::candidates};
  return all;
}

std::vector<Claim> list_of(const Claims& claims) {
  std::vector<Claim> list;
  std::copy_if(all_claims().begin(), all_claims().end(), std::back_inserter(list),
               [&](Claim claim) { return claims.has(claim); });
  return list;
}

std::vector<Claim> judged_claims(const Claims& claims, const Contract& contract) {
  auto judged = list_of(claims);
  if (contract.margin > 0) std::erase(judged, Claim::no_spurious);
  if (!contract.reports_pairs) {
    std::erase(judged, Claim::first_pairs);
    std::erase(judged, Claim::all_pairs);
  }
  return judged;
}

Claims claims_of(const detector::Options& options) {
  using detector::Arithmetic;
  const bool exact = options.arithmetic == Arithmetic::exact;
  const bool proved = exact || options.arithmetic == Arithmetic::bounded;
  return {.free_sound = proved,
          .not_late = proved,
          .first_time = proved,
          .first_pairs = proved,
          .all_pairs = proved && options.pairs == detector::Pairs::all,
          .no_spurious = exact,
          .deterministic = true,
          .total = true};
}

}  // namespace assay::properties
