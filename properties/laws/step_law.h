// The form of a law: a function that looks at one step (or at a whole case).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"

namespace assay::properties {

// Each function returns the laws of one file; the laws of a file are about one thing. law.cpp joins
// the lists.

std::span<const Law> view_laws();            // L1, L2, sets
std::span<const Law> first_contact_laws();   // L3, L6
std::span<const Law> one_sign_laws();        // L4, L5
std::span<const Law> pair_set_laws();        // L7, claims
std::span<const Law> state_laws();           // L8, L9
std::span<const Law> component_laws();       // L10
std::span<const Law> boundary_laws();        // L11
std::span<const Law> doubtful_input_laws();  // L12
std::span<const Law> normal_cone_laws();     // L13
std::span<const Law> change_laws();          // L18; metamorphic: the mesh in another form
std::span<const Law> repetition_laws();      // metamorphic: the same steps in another way
std::span<const Law> question_laws();        // L16, L17, stops
std::span<const Law> option_laws();          // pairs of options, states, sizes

// The observation of a law in a step: nothing if the premise of the law does not hold, an empty
// text if the law holds, and a text that says how the law is broken if it is broken.
using Observation = std::optional<std::string>;

inline Observation not_met() { return std::nullopt; }
inline Observation holds() { return std::string(); }
inline Observation holds_if(bool condition, std::string_view otherwise) {
  return condition ? holds() : Observation(otherwise);
}

// Law::one_in of a law that runs the case again, which takes long.
inline constexpr int one_case_in_16 = 16;

// Returns whether the law was close in a step in which its premise held (law.h).
using IsClose = bool (*)(CaseFacts&, std::size_t);
inline bool is_close_by_view(CaseFacts& facts, std::size_t step) { return facts.is_close(step); }

void note(CaseFacts& facts, std::size_t step, const Observation& finding, LawTally& tally,
          IsClose is_close = is_close_by_view);

template <Observation (*look)(CaseFacts&, std::size_t), IsClose is_close = is_close_by_view>
void each_step(CaseFacts& facts, LawTally& tally) {
  for (std::size_t s = 0; s < facts.steps(); ++s) note(facts, s, look(facts, s), tally, is_close);
}

// Returns the first field in which two results of a step differ, to the last bit; empty if none
// does. Wall-clock times are not compared.
std::string difference(const StepResult& a, const StepResult& b);

}  // namespace assay::properties
