// What a search knows of a triangle. The type determines the triangle's flags, and it tells apart
// triangles that have the same flags.
//
// The first search of a step knows five types. The closure (L7) searches again, round by round, for
// partners of the triangles of V+ and V- that were found in contact. Their types follow the rounds:
//
//   positive -> positive_grown -> positive_joined
//   negative -> negative_grown -> negative_joined
//
// The first arrow is taken when a contact of the triangle is found, the second at the end of the
// next round. In the round between them the triangle has the flag `grown`: it is tested against its
// whole component, and what earlier searches tested is passed over. The other types stay, because
// V0 and Vv were tested against everything in the first search.
//
// Example: the first search finds V+ triangle 3 in contact with V0 triangle 7, so 3 becomes
// positive_grown. Round 1 finds that 3 meets V+ triangle 9 too, so 3 becomes positive_joined and 9
// positive_grown. Round 2 tests 9, finds nothing new, and the closure ends.
#pragma once

#include <array>
#include <cstdint>

#include "detector/search/pair_rule.h"

namespace assay::detector {

enum class TriangleType : std::uint8_t {
  positive,        // V+
  negative,        // V-
  zero,            // V0
  violated,        // Vv: touched by a ghost; in a step without views, every clean triangle
  dirty,           // Vv: it may be in contact with its own component already at t=0
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
// Whether it holds one type, or none.
constexpr bool is_single(TypeSet types) { return (types & (types - 1)) == 0; }

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
