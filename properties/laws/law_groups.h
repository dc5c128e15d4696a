// One function for each file in which laws are written. A file holds a few laws about one thing.
#pragma once

#include <span>
#include <vector>

#include "properties/laws/law.h"

namespace assay::properties {

std::span<const Law> view_value_laws();      // L1
std::span<const Law> view_set_laws();        // L2, sets
std::span<const Law> first_contact_laws();   // L3, L6
std::span<const Law> one_sign_laws();        // L4
std::span<const Law> all_positive_laws();    // L5
std::span<const Law> pair_set_laws();        // L7, claims
std::span<const Law> state_laws();           // L8, L9
std::span<const Law> component_laws();       // L10
std::span<const Law> boundary_laws();        // L11
std::span<const Law> doubtful_input_laws();  // L12
std::span<const Law> normal_cone_laws();     // L13
std::span<const Law> change_laws();          // metamorphic: the mesh in another form
std::span<const Law> repetition_laws();      // metamorphic: the same step in another way

// In the order of laws().
inline std::vector<std::span<const Law>> law_groups() {
  return {view_value_laws(),   view_set_laws(),       first_contact_laws(), one_sign_laws(),
          all_positive_laws(), pair_set_laws(),       state_laws(),         component_laws(),
          boundary_laws(),     doubtful_input_laws(), normal_cone_laws(),   change_laws(),
          repetition_laws()};
}

}  // namespace assay::properties
