// What a search knows of a triangle. The type determines the triangle's flags, and it tells apart
// triangles that have the same flags.
#pragma once

#include <array>
#include <cstdint>

#include "detector/search/pair_rule.h"

namespace assay::detector {

enum class TriangleType : std::uint8_t {
  positive,  // V+
  negative,  // V-
  zero,      // V0
  violated,  // Vv: touched by a ghost; in a step without views, every clean triangle
  dirty,     // Vv: it may be in contact with its own component already at t=0
  // Types of the closure (L7). V0 and Vv need none, because they were tested against everything.
  positive_grown,  // V+, joined H in this round
  negative_grown,
  positive_joined,  // V+, joined H in an earlier round
  negative_joined,
};
inline constexpr std::size_t triangle_types = 9;

// A set of types, a bit each.
using TypeSet = std::uint16_t;
constexpr TypeSet set_of(TriangleType type) {
  return static_cast<TypeSet>(1u << static_cast<unsigned>(type));
}

namespace type_flags {
using Table = std::array<std::uint8_t, triangle_types>;
constexpr std::uint8_t p = flag::positive, n = flag::negative, z = flag::zero, v = flag::violated,
                       g = flag::grown;
// The flags of each type in the present search.
inline constexpr Table now = {p, n, z, v, v, p | g, n | g, p, n};
// The flags that a triangle of this type had in the first search, before the closure.
inline constexpr Table first = {p, n, z, v, v, p, n, p, n};
// Those that it had in some earlier round of the closure.
inline constexpr Table earlier_round = {p, n, z, v, v, p, n, p | g, n | g};
}  // namespace type_flags

constexpr std::uint8_t flags_of(TriangleType type) {
  return type_flags::now[static_cast<std::size_t>(type)];
}

}  // namespace assay::detector
