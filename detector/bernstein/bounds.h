// The numbers that a filter computes in, and by how much it holds a computed one to be off: the
// policy over which filters are written once.
//
// Every bound is a derived constant times `unit`. With unit 0 the bounds vanish: a computed sign is
// taken for the sign, zero for zero.
#pragma once

namespace assay::detector {

inline constexpr double unit_roundoff = 0x1p-53;

// Doubles, each rounding off by at most 2^-53 of the result: bounds that hold.
struct ProvedBounds {
  using Number = double;
  static constexpr bool proved = true;
  static constexpr Number unit = unit_roundoff;
};

// Plain arithmetic in T.
template <class T>
struct NoBounds {
  using Number = T;
  static constexpr bool proved = false;
  static constexpr Number unit = 0;
};

}  // namespace assay::detector
