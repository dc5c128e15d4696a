#include "properties/claims/claims.h"

namespace assay::properties {

std::vector<Claim> list_of(const Claims& claims) {
  std::vector<Claim> list;
  for (const Claim claim : all_values<Claim>) {
    if (claims_from_outside.has(claim) && claims.has(claim)) list.push_back(claim);
  }
  return list;
}

std::vector<Claim> all_claims() { return list_of(claims_from_outside); }

Claims judged_claims(const Claims& claims, const Contract& contract, bool of_queries) {
  Claims judged = claims;
  if (contract.margin > 0) judged.set(Claim::first_time, false);
  if (!contract.judges_alarms(of_queries)) judged.set(Claim::no_spurious, false);
  return contract.reports_pairs ? judged : judged.without({Claim::first_pairs, Claim::all_pairs});
}

Contract contract_of(const detector::Options& options) {
  Contract contract;
  if (options.separation > 0) contract.adjacency = Adjacency::no_shared_vertex;
  contract.separation = options.separation;
  return contract;
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
