#include "properties/worker/plugin/plugin_description.h"

#include <cctype>

namespace assay::properties {

std::string fault_of_name(std::string_view name) {
  constexpr std::size_t longest = 100;
  if (name.size() > longest)
    return "a name or version of " + std::to_string(name.size()) + " bytes, and 100 are the most";
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
    return has_limit ? "a function limit, and no claim on what it allows"
                     : "claims on limits, and no such function";
  if (claims.has(Claim::progress) != (contract.progress > 0))
    return "a claim on progress without a number, or a number without the claim";
  return "";
}

Claims claims_on_steps(const PluginDescription& description) {
  if (description.parts.steps) return description.claims;
  Claims claims = claims_on_limits;
  for (const Claim claim : {Claim::deterministic, Claim::total, Claim::candidates})
    claims.set(claim);
  return description.claims.only(claims);
}

Claims claims_on_queries(const PluginDescription& description) {
  return description.claims.without(claims_on_limits)
      .without({Claim::first_pairs, Claim::all_pairs, Claim::candidates});
}

}  // namespace assay::properties
