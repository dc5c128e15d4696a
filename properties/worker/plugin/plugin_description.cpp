#include "properties/worker/plugin/plugin_description.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <vector>

namespace assay::properties {
namespace {

std::vector<char32_t> characters_of(std::string_view utf8) {
  std::vector<char32_t> characters;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_next = (byte & 0xc0) == 0x80 && !characters.empty();
    if (is_next) {
      characters.back() = characters.back() << 6 | (byte & 0x3f);
    } else {
      const int bits = byte < 0x80 ? 0x7f : byte < 0xe0 ? 0x1f : byte < 0xf0 ? 0x0f : 0x07;
      characters.push_back(static_cast<char32_t>(byte & bits));
    }
  }
  return characters;
}

// Unicode's characters without width, other spaces than the plain one, and marks of direction.
bool is_invisible(char32_t c) {
  constexpr char32_t ranges[][2] = {
      {0x80, 0xa0},     {0xad, 0xad},     {0x34f, 0x34f},   {0x61c, 0x61c},     {0x115f, 0x1160},
      {0x1680, 0x1680}, {0x17b4, 0x17b5}, {0x180b, 0x180f}, {0x2000, 0x200f},   {0x2028, 0x202f},
      {0x205f, 0x206f}, {0x2800, 0x2800}, {0x3000, 0x3000}, {0x3164, 0x3164},   {0xfe00, 0xfe0f},
      {0xfeff, 0xfeff}, {0xffa0, 0xffa0}, {0xfff0, 0xfffb}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [c](const auto& range) { return range[0] <= c && c <= range[1]; });
}

}  // namespace

std::string fault_of_name(std::string_view name) {
  constexpr std::size_t longest = 100;
  const auto characters = characters_of(name);
  if (characters.size() > longest)
    return "a name or version of " + std::to_string(characters.size()) +
           " characters, and 100 are the most";
  if (std::any_of(characters.begin(), characters.end(), is_invisible))
    return "a name or version with characters that nobody sees";
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
