// Degeneracies of a query: how near it is to each, and steps onto them.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "detector/mesh/step_types.h"
#include "properties/words.h"

namespace assay::properties {

// How near a query is to each way of being degenerate, by the oracle's exact polynomials.

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

// Newton steps of a query onto degeneracies: the points are moved, as little as may be, until
// polynomials of the query are 0 at a time. It computes in doubles, so it comes within rounding of
// what it aims at; lattice walks (moves.h) do the rest, and the oracle judges.

enum class Degeneracy : std::uint8_t {
  coplanar,     // F(t) = 0: a root at t, be it 0, 1 or in between
  double_root,  // F(t) = F'(t) = 0
  flat,         // F = 0 throughout
  side,         // L_i(t) = 0 on the axis of the greatest normal
  no_normal,    // the normal is 0 at t: no area, or parallel edges
};

struct DegeneracyAt {
  Degeneracy kind = Degeneracy::coplanar;
  double time = 0;
  int side = 0;  // i of L_i
};

// Nothing if the steps do not come near, or if a number overflows on the way. The points whose bit
// of `moving` is set move: bit i for point i at t = 0, bit 4 + i for it at t = 1. About 20 us.
inline constexpr unsigned all_ends_move = 0xff;
std::optional<detector::FourPoints> moved_onto(const detector::FourPoints& query,
                                               std::span<const DegeneracyAt> goals,
                                               unsigned moving = all_ends_move);

// F at a time, and the first root in [0, 1] that doubles see; nothing if they see none.
double coplanarity_at(const detector::FourPoints& query, double time);
std::optional<double> root_of(const detector::FourPoints& query);

}  // namespace assay::properties
