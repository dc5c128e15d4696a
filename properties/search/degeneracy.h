// Measures how near a query is to each degeneracy, and moves a query onto degeneracies.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "properties/words.h"

namespace assay::properties {

// Measures how near a query is to each degeneracy, by the oracle's exact polynomials.

// The kinds of degeneracy that make a query hard. Notation: oracle/query/contact_events.h.
enum class Hardness : std::uint8_t {
  double_root,  // two roots of F coincide: its discriminant is 0
  end_of_step,  // a root at t = 0 or t = 1
  side,         // the contact is at the end of a feature: some L is 0 at a root
  flat,         // F is 0 throughout
  no_area,      // the normal is 0 at a root: a face without area, or parallel edges
  bound,        // the least Bernstein coefficient of F lies at the error bound of a filter
  distance,     // the least distance is the query's distance or, if nothing meets, is 0
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

// For each kind, how far the query is from it: a share from 0 (exactly degenerate) to 1. At a root
// that is no double, a share below 2^-53 can be rounded to 0. Three questions are decided exactly:
// whether F is 0 at t = 0 or 1, whether its discriminant is 0, and whether F is 0 throughout.
struct Gap {
  std::array<double, all_values<Hardness>.size()> share{};
  double& operator[](Hardness kind) { return share[static_cast<std::size_t>(kind)]; }
  double operator[](Hardness kind) const { return share[static_cast<std::size_t>(kind)]; }
};

// Returns the gap of a query. `time` is the time at which the features meet, or, if they do not, at
// which they are examined. `separation` is the query's distance, 0 for a contact. About 10 us.
Gap gap_of(const FourPoints& query, double time, double separation = 0);

// Returns one number by which queries are compared, from 0 to 96: the bits of the smallest share,
// plus half of the bits of the next smallest. A share of 0 counts as 64 bits.
double nearness(const Gap& gap);

// Moves a query onto degeneracies by Newton steps: the points move as little as possible, until
// polynomials of the query are 0 at a given time. The steps are computed in doubles, so they come
// within rounding of the degeneracy; lattice walks (moves.h) do the rest, and the oracle judges.

enum class Degeneracy : std::uint8_t {
  coplanar,     // F(t) = 0: a root at t, which may be 0 or 1
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

// All four points move, at t = 0 and at t = 1 (moved_onto).
inline constexpr unsigned all_ends_move = 0xff;
// Returns the moved query; nothing if the steps do not come near the goals, or if a number
// overflows on the way. The bits of `moving` name the places that move: bit i is point i at t = 0,
// bit 4 + i is point i at t = 1. About 20 us.
std::optional<FourPoints> moved_onto(const FourPoints& query, std::span<const DegeneracyAt> goals,
                                     unsigned moving = all_ends_move);

// `coplanarity_at` returns F at a time. `root_of` returns the first root of F in [0, 1], in
// doubles; nothing if F has none.
double coplanarity_at(const FourPoints& query, double time);
std::optional<double> root_of(const FourPoints& query);

}  // namespace assay::properties
