#include "properties/claims/claims.h"

#include <cctype>

namespace assay::properties {

std::vector<Claim> list_of(const Claims& claims) {
  std::vector<Claim> list;
  for (const Claim claim : all_values<Claim>) {
    if (claims_from_outside.has(claim) && claims.has(claim)) list.push_back(claim);
  }
  return list;
}

std::vector<std::string> words_of(const Claims& claims) {
  std::vector<std::string> words;
  for (const auto claim : list_of(claims)) words.emplace_back(name_of(claim));
  return words;
}

Claims claims_named(const std::vector<std::string>& words) {
  Claims claims;
  for (const auto& word : words)
    if (const auto claim = from_name<Claim>(word)) claims.set(*claim);
  return claims;
}

Claims judged_claims(const Claims& claims, const Contract& contract, bool of_queries) {
  Claims rest = claims;
  for (const auto& row : all_rows<Claim>)
    if (*row.why_void(contract, of_queries)) rest.set(row.value, false);
  return rest;
}

void weigh(const Claims& claims, StepDiff& diff) {
  for (const auto& row : all_rows<Claim>)
    if (claims.has(row.value) && row.symptom_of(diff).kind) diff.breaches.push_back(row.value);
  if (!diff.breaches.empty()) diff.outcome = Outcome::defect;
}

Contract contract_of(const Options& options) {
  Contract contract;
  if (options.separation > 0) contract.adjacency = Adjacency::no_shared_vertex;
  contract.separation = options.separation;
  return contract;
}

std::string fault_of_name(std::string_view name) {
  constexpr std::size_t longest = 100;
  if (name.size() > longest)
    return "a name or version of " + std::to_string(name.size()) + " bytes, but 100 are allowed";
  if (name.starts_with(' ') || name.ends_with(' '))
    return "a name or version that begins or ends with a space";
  // However it is written: "Built in", "built-in 1".
  std::string letters;
  for (const unsigned char c : name) {
    if (std::isalpha(c) != 0) letters += static_cast<char>(std::tolower(c));
  }
  if (letters == "builtin") return "the name of the built-in detector";
  return "";
}

std::string fault_of_limits(const Claims& claims, const Contract& contract, bool has_limit) {
  if (claims.has_any(claims_on_limits) != has_limit)
    return has_limit ? "a function `limit`, but no claim about limits"
                     : "claims about limits, but no function `limit`";
  if (claims.has(Claim::progress) != (contract.progress > 0))
    return "only one of the claim `progress` and the number `progress`";
  return "";
}

Claims claims_on_steps(const PluginDescription& description) {
  if (description.parts.steps) return description.claims;
  return description.claims.only(claims_about({About::limits, About::broad_phase, About::runs}));
}

Claims claims_on_queries(const PluginDescription& description) {
  return description.claims.only(claims_about({About::answers, About::times, About::runs}));
}

}  // namespace assay::properties
