// Says which triangle pairs a step looks for, and which pairs of tree nodes can contain such pairs.
//
// Inside a component these are the pairs of K = (V+,V-) u (U,V0) u (U,Vv) (L3; U is the set of ALL
// triangles, including V0 and Vv). Between two components they are all pairs (L10). They include
// pairs that share a vertex or an edge.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// The set that a triangle is in; for a node, the sets of the triangles below it.
namespace flag {
inline constexpr std::uint8_t positive = 1;  // P: V+
inline constexpr std::uint8_t negative = 2;  // N: V-
inline constexpr std::uint8_t zero = 4;      // Z: V0
inline constexpr std::uint8_t violated = 8;  // V: Vv, touched by a ghost or dirty
inline constexpr std::uint8_t grown = 16;    // with P or N: joined H in this closure round (L7)
inline constexpr int count = 5;
}  // namespace flag

// A symmetric relation between the sets that flags stand for. A node has a union of such sets; one
// look-up compares two unions.
class PairTable {
 public:
  // Makes a table without pairs, which asks for nothing.
  PairTable() = default;
  // Add to the table, or remove from it, the pairs of a triangle with flag `a` and a triangle with
  // flag `b`.
  PairTable& add(std::uint8_t a, std::uint8_t b);
  PairTable& remove(std::uint8_t a, std::uint8_t b);
  static PairTable everything();

  // Returns whether the table has a pair of some flag of `a` and some flag of `b`.
  bool asks(std::uint8_t a, std::uint8_t b) const { return (partners_[a] & b) != 0; }
  // Returns all flags that are in a pair with some flag of `a`.
  std::uint8_t partners(std::uint8_t a) const { return partners_[a]; }
  // Returns the table with all pairs of this table and of `other`.
  PairTable joined_with(const PairTable& other) const;

 private:
  void update();
  static constexpr std::size_t unions = std::size_t{1} << flag::count;
  std::array<std::uint8_t, unions> partners_{};
};

// The tables of one search: `within` for pairs of one component, `across` for pairs of two.
struct PairTables {
  PairTable within, across;
};

// The stage of the detector that says which pairs a step asks for.
class PairRule {
 public:
  virtual ~PairRule() = default;
  // Returns the tables of the first search: K inside a component, every pair of two components.
  virtual PairTables candidates() const;
  // Returns the tables of a round of the closure: every triangle that has joined H in this round,
  // with all triangles of its component (U,H). Pairs of two components are not asked for, because
  // the first search has asked for all of them.
  virtual PairTables closure() const;
  // Returns whether triangle `t` of this contact joins H. This implementation always returns true,
  // by L7. REQUIRES that both triangles of the contact are of one component.
  virtual bool joins_closure(const TrianglePair& contact, std::int32_t t) const;
};

// The rule of cullings without views: it asks for every pair, so there is no closure.
class EveryPair : public PairRule {
 public:
  PairTables candidates() const override;
};

// The type of a triangle in a search. It determines the flags of the triangle. Triangles with the
// same flags can have different types.
//
// The first search of a step has the first five types. The closure (L7) searches again, round by
// round, for partners of the triangles of V+ and V- that were found in contact. These triangles
// change their types with the rounds:
//
//   positive -> positive_grown -> positive_joined
//   negative -> negative_grown -> negative_joined
//
// The first change is made when a contact of the triangle is found, the second at the end of the
// next round. In that round the triangle has the flag `grown`: it is tested against its whole
// component, except for pairs that earlier searches have tested. Triangles of other types keep
// their type, because V0 and Vv were tested against everything in the first search.
//
// Example: the first search finds V+ triangle 3 in contact with V0 triangle 7, so 3 becomes
// positive_grown. Round 1 finds that 3 meets V+ triangle 9 too, so 3 becomes positive_joined and 9
// positive_grown. Round 2 tests 9, finds nothing new, and the closure ends.
enum class TriangleType : std::uint8_t {
  positive,        // V+
  negative,        // V-
  zero,            // V0
  violated,        // Vv: touched by a ghost; in a step without views, every clean triangle
  dirty,           // Vv: possibly in contact with its own component already at t=0
  positive_grown,  // V+, joined H in this round
  negative_grown,
  positive_joined,  // V+, joined H in an earlier round
  negative_joined,
};
inline constexpr std::size_t triangle_types = 9;

// Returns whether all triangles have one type. Takes 30 ns for a thousand triangles.
inline bool are_of_one_type(std::span<const TriangleType> types) {
  return types.empty() || std::memcmp(types.data(), types.data() + 1, types.size() - 1) == 0;
}

// A set of types: one bit for each type.
using TypeSet = std::uint16_t;
constexpr TypeSet set_of(TriangleType type) {
  return static_cast<TypeSet>(1u << static_cast<unsigned>(type));
}
// Returns whether the set has at most one type.
constexpr bool is_single(TypeSet types) { return (types & (types - 1)) == 0; }

namespace type_flags {
using Table = std::array<std::uint8_t, triangle_types>;
constexpr std::uint8_t p = flag::positive, n = flag::negative, z = flag::zero, v = flag::violated,
                       g = flag::grown;
// The flags of each type in the present search.
inline constexpr Table now = {p, n, z, v, v, p | g, n | g, p, n};
// The flags that a triangle of this type had in the first search, before the closure.
inline constexpr Table first = {p, n, z, v, v, p, n, p, n};
// The flags that a triangle of this type had in some earlier round of the closure.
inline constexpr Table earlier_round = {p, n, z, v, v, p, n, p | g, n | g};
}  // namespace type_flags

constexpr std::uint8_t flags_of(TriangleType type) {
  return type_flags::now[static_cast<std::size_t>(type)];
}

// The vBVHs of the thesis, as flags on one tree: they say which nodes have triangles of V+, V-, V0
// and Vv below them.
//
// A node has the flags P, N, Z, V (and `grown` in the closure) of all triangles below it. The nodes
// with a given flag are the partial tree of that set. Flags are kept from step to step. A marking
// gets the types of all triangles and compares them with the types of the LAST MARKING, which can
// be several steps ago, because a step that ends as free by L5 does not mark. From each leaf whose
// type has changed it works upward:
//   a new flag is set on each ancestor, up to an ancestor that has this flag already;
//   a lost flag is cleared on each ancestor, up to one whose other child has this flag.
// All new flags are set before any flag is cleared, so no flag is cleared and set again. The flags
// do not depend on the order in which triangles change. The work is the number of nodes whose flags
// change: at most the depth of the tree for each changed triangle. If a quarter of the triangles of
// a large mesh have changed, for example in the first step with views, one pass over all nodes
// takes less work and is made instead.
struct Marks {
  // At first all triangles are in V+: every node has the flag P and no other flag.
  explicit Marks(const BoundingVolumeTree& tree);

  std::vector<TriangleType> types;      // of the last marking, by triangle
  LargeArray<std::uint8_t> node_flags;  // by node
  // Triangles whose type the last marking changed, ascending. The capacity is the number of all
  // triangles from the start, so that marking allocates nothing.
  LargeArray<std::int32_t> changed;

  std::uint8_t flags(std::int32_t triangle) const {
    return flags_of(types[static_cast<std::size_t>(triangle)]);
  }
};

// The stage of the detector that sets the marks.
class Marking {
 public:
  virtual ~Marking() = default;

  // Sets the types of all triangles, and the flags of all nodes accordingly. Allocates nothing. If
  // all triangles have one type, which is so in a step without views, this does not go over the
  // nodes.
  void bring_to(std::span<const TriangleType> types, const BoundingVolumeTree& tree, Marks& marks,
                MarkingCounts& counts) const;
  // Sets the types of some triangles, and the flags of all nodes accordingly.
  struct Change {
    std::int32_t triangle;
    TriangleType type;
  };
  void change(std::span<const Change> changes, const BoundingVolumeTree& tree, Marks& marks,
              MarkingCounts& counts) const;

 protected:
  // `mark` sets flags on a leaf and its ancestors; `clear` clears flags there.
  virtual void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                    Marks& marks, MarkingCounts& counts) const;
  virtual void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                     Marks& marks, MarkingCounts& counts) const;

 private:
  // Sets the flags of all nodes according to the new types of the triangles in marks.changed.
  void update(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts) const;
  // Does the same by one pass over all nodes. REQUIRES types that have one flag each, which is so
  // in a first search.
  static void mark_anew(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts);
};

}  // namespace assay::detector
