// The policy of a filter: in which numbers it computes, and by how much a computed number is
// assumed to be off. Filters are written once, as templates over this policy.
//
// Every error bound is a derived constant times `unit`. With unit 0 the bounds vanish: then the
// sign of a computed number is taken for the true sign, and a computed zero for zero.
#pragma once

namespace assay::detector {

inline constexpr double unit_roundoff = 0x1p-53;

// Doubles with bounds that hold: each rounding is off by at most 2^-53 of the result.
struct ProvedBounds {
  using Number = double;
  static constexpr bool proved = true;
  static constexpr Number unit = unit_roundoff;
};

// Plain arithmetic in T, without bounds.
template <class T>
struct NoBounds {
  using Number = T;
  static constexpr bool proved = false;
  static constexpr Number unit = 0;
};

}  // namespace assay::detector
