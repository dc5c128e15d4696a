// How near a query is to each way of being degenerate, by the oracle's exact polynomials.
#pragma once

#include <array>

#include "detector/mesh/step_types.h"
#include "properties/words.h"

namespace assay::properties {

// Ways in which a query is hard. Notation: oracle/query/contact_events.h.
enum class Hardness : std::uint8_t {
  double_root,  // two roots of F coincide: its discriminant is 0
  end_of_step,  // a root at t = 0 or t = 1
  side,         // the contact is at the end of a feature: an L is 0 at a root
  flat,         // F is 0 throughout
  no_area,      // the normal is 0 at a root: a face without area, or parallel edges
  bound,        // the least Bernstein coefficient of F lies at the error bound of a filter
  distance,     // the least distance is that which is asked about, or 0 without a contact
};
constexpr auto names_of(Hardness) {
  using enum Hardness;
  return std::to_array<Named<Hardness>>({{double_root, "double root"},
                                         {end_of_step, "end of the step"},
                                         {side, "end of a feature"},
                                         {flat, "coplanar throughout"},
                                         {no_area, "without area"},
                                         {bound, "at an error bound"},
                                         {distance, "at the distance"}});
}

// A share from 0, for exactly so, to 1 for each kind. A share below 2^-53 may be told as 0 where it
// is a value at a root, which is no double; zeros of F at an end, of its discriminant and of F
// itself are exact.
struct Gap {
  std::array<double, all_values<Hardness>.size()> share{};
  double& operator[](Hardness kind) { return share[static_cast<std::size_t>(kind)]; }
  double operator[](Hardness kind) const { return share[static_cast<std::size_t>(kind)]; }
};

// `time` is when the features meet, or where they are looked at if they do not. The distance asked
// about is 0 for a contact. About 10 us.
Gap gap_of(const detector::FourPoints& query, double time, double separation = 0);

// One number to compare queries by: the bits of the smallest share, and half of those of the next.
// From 0 to 96; a share of 0 counts as 64 bits.
double nearness(const Gap& gap);

}  // namespace assay::properties
