// How a law is written: as a function that looks at one step (or at a whole case).
#pragma once

#include <optional>
#include <string>

#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"

namespace assay::properties {

// What a law observes: nothing if its premise does not hold; else what is wrong, as a text that is
// empty if the law holds.
using Observation = std::optional<std::string>;

inline Observation not_met() { return std::nullopt; }
inline Observation holds() { return std::string(); }
inline Observation holds_if(bool condition, std::string_view otherwise) {
  return condition ? holds() : Observation(otherwise);
}

// For a law that runs the case again, which takes long: it is checked on one case in 16.
inline constexpr int one_case_in_16 = 16;

// Whether the law was close in a step in which its premise held (law.h).
using IsClose = bool (*)(CaseFacts&, std::size_t);
inline bool is_close_by_view(CaseFacts& facts, std::size_t step) { return facts.is_close(step); }

void note(CaseFacts& facts, std::size_t step, const Observation& finding, LawTally& tally,
          IsClose is_close = is_close_by_view);

template <Observation (*look)(CaseFacts&, std::size_t), IsClose is_close = is_close_by_view>
void each_step(CaseFacts& facts, LawTally& tally) {
  for (std::size_t s = 0; s < facts.steps(); ++s) note(facts, s, look(facts, s), tally, is_close);
}

}  // namespace assay::properties
