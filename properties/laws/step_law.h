// How a law is written: a function that looks at one step (or at a whole case).
#pragma once

#include <optional>
#include <string>

#include "properties/laws/case_facts.h"
#include "properties/laws/law.h"

namespace assay::properties {

// Nothing where the premise does not hold; else what is wrong, empty when the law holds.
using Finding = std::optional<std::string>;

inline Finding not_met() { return std::nullopt; }
inline Finding holds() { return std::string(); }
inline Finding holds_if(bool condition, std::string_view otherwise) {
  return condition ? holds() : Finding(otherwise);
}

// Share of the cases for laws that run the case again.
inline constexpr int dear = 8;

void note(CaseFacts& facts, std::size_t step, const Finding& finding, LawTally& tally);

template <Finding (*look)(CaseFacts&, std::size_t)>
void each_step(CaseFacts& facts, LawTally& tally) {
  for (std::size_t s = 0; s < facts.steps(); ++s) note(facts, s, look(facts, s), tally);
}

}  // namespace assay::properties
