// Newton steps of a query onto degeneracies: the points are moved, as little as may be, until
// polynomials of the query are 0 at a time. It computes in doubles, so it comes within rounding of
// what it aims at; lattice walks (moves.h) do the rest, and the oracle judges.
#pragma once

#include <optional>
#include <span>

#include "detector/mesh/step_types.h"
#include "properties/random.h"

namespace assay::properties {

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
