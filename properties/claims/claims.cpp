#include "properties/claims/claims.h"

#include <iterator>

#include "properties/words.h"

namespace assay::properties {
namespace {

constexpr const char* words[] = {"free-sound", "not-late",    "first-time",    "first-pairs",
                                 "all-pairs",  "no-spurious", "deterministic", "total",
                                 "candidates", "times-unique"};

}  // namespace

const char* name_of(Claim claim) { return word_of(words, claim); }

std::vector<Claim> list_of(const Claims& claims) {
  std::vector<Claim> list;
  for (std::uint8_t number = 0; number < std::size(words); ++number) {
    const auto claim = static_cast<Claim>(number);
    if (claims_from_outside.has(claim) && claims.has(claim)) list.push_back(claim);
  }
  return list;
}

std::vector<Claim> all_claims() { return list_of(claims_from_outside); }

Claims judged_claims(const Claims& claims, const Contract& contract) {
  Claims judged = claims;
  if (contract.margin > 0) judged.set(Claim::no_spurious, false);
  return contract.reports_pairs ? judged : judged.without({Claim::first_pairs, Claim::all_pairs});
}

Claims claims_of(const detector::Options& options) {
  using detector::Arithmetic;
  const bool exact = options.arithmetic == Arithmetic::exact;
  Claims claims = {Claim::deterministic, Claim::total};
  if (!exact && options.arithmetic != Arithmetic::bounded) return claims;
  for (const Claim proved :
       {Claim::free_sound, Claim::not_late, Claim::first_time, Claim::first_pairs})
    claims.set(proved);
  claims.set(Claim::all_pairs, options.pairs == detector::Pairs::all);
  return claims.set(Claim::no_spurious, exact).set(Claim::times_unique, exact);
}

}  // namespace assay::properties
