// Says which triangle pairs a step looks at, and which pairs of tree nodes may hold such pairs.
//
// Inside a component these are the pairs of K = (V+,V-) u (U,V0) u (U,Vv) (L3; U are ALL
// triangles, those of V0 and Vv included). Between two components they are all pairs (L10). Pairs
// that share a vertex or an edge are looked at too.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
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

// A symmetric relation between sets of triangles. For unions of sets, as nodes have them, it is
// answered by one look-up.
class PairTable {
 public:
  // An empty table asks for nothing.
  PairTable() = default;
  // Begin or stop asking for the pairs of a triangle with flag `a` and one with flag `b`.
  PairTable& add(std::uint8_t a, std::uint8_t b);
  PairTable& remove(std::uint8_t a, std::uint8_t b);
  static PairTable everything();

  // Returns whether some flag of `a` is asked for together with some flag of `b`.
  bool asks(std::uint8_t a, std::uint8_t b) const { return (partners_[a] & b) != 0; }
  // Returns the flags that some flag of `a` asks for.
  std::uint8_t partners(std::uint8_t a) const { return partners_[a]; }
  // Returns the table that asks for every pair that one of the two tables asks for.
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

// Which pairs a step asks for; a stage of the detector.
class PairRule {
 public:
  virtual ~PairRule() = default;
  // Returns the pairs of the first search: K inside a component, every pair of two components.
  virtual PairTables candidates() const;
  // Returns the pairs of a round of the closure: every triangle that has joined H, against its
  // whole component (U,H). Pairs of triangles of different components are not asked for, because
  // the first search looked at all of them.
  virtual PairTables closure() const;
  // Returns whether triangle `t` of this contact, which is within one component, joins H. By L7
  // both triangles of the contact join.
  virtual bool joins_closure(const TrianglePair& contact, std::int32_t t) const;
};

// The rule of cullings without views: it asks for every pair, so nothing is left to close.
class EveryPair : public PairRule {
 public:
  PairTables candidates() const override;
};

// The type of a triangle in a search. It determines the triangle's flags, and it tells apart
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
// whole component, and pairs that earlier searches tested are passed over. The other types stay,
// because V0 and Vv were tested against everything in the first search.
//
// Example: the first search finds V+ triangle 3 in contact with V0 triangle 7, so 3 becomes
// positive_grown. Round 1 finds that 3 meets V+ triangle 9 too, so 3 becomes positive_joined and 9
// positive_grown. Round 2 tests 9, finds nothing new, and the closure ends.
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

// Returns whether all triangles have one type.
inline bool are_of_one_type(std::span<const TriangleType> types) {
  return std::adjacent_find(types.begin(), types.end(), std::not_equal_to<>()) == types.end();
}

// A set of types, a bit each.
using TypeSet = std::uint16_t;
constexpr TypeSet set_of(TriangleType type) {
  return static_cast<TypeSet>(1u << static_cast<unsigned>(type));
}
// Returns whether the set holds one type, or none.
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

// The vBVHs of the thesis, as flags on the one tree: which nodes hold triangles of V+, V-, V0, Vv.
//
// A node has the flags P, N, Z, V (and `grown` in the closure) of all triangles below it. The
// nodes with one flag are the partial tree of that set. Flags are kept from step to step. A
// marking is given the types of all triangles and compares them with those of the LAST MARKING,
// which may be several steps ago, because a step that ends as free by L5 does not mark. From each
// leaf that changed it works upward:
//   a new flag is set on each ancestor until one has it already;
//   a lost flag is cleared on each ancestor until one has it from its other child.
// All new flags are set before any is cleared, so no flag is taken away and given back. The flags
// do not depend on the order in which triangles change. The work is the number of nodes whose flags
// change: at most the depth of the tree for each changed triangle. Where a quarter of a large mesh
// has changed, as in the first step with views, one pass over all nodes takes less.
struct Marks {
  // At first all triangles are V+: every node has the flag P and no other.
  explicit Marks(const BoundingVolumeTree& tree);

  std::vector<TriangleType> types;      // of the last marking, by triangle
  LargeArray<std::uint8_t> node_flags;  // by node
  // Triangles whose type the last marking changed, ascending. Its capacity is all triangles from
  // the start, so that marking allocates nothing.
  LargeArray<std::int32_t> changed;

  std::uint8_t flags(std::int32_t triangle) const {
    return flags_of(types[static_cast<std::size_t>(triangle)]);
  }
};

// A stage of the detector.
class Marking {
 public:
  virtual ~Marking() = default;

  // Sets the types of all triangles, and the flags to match. Allocates nothing. If all triangles
  // have one type, as in a step without views, the nodes are not walked over.
  void bring_to(std::span<const TriangleType> types, const BoundingVolumeTree& tree, Marks& marks,
                MarkingCounts& counts) const;
  // Sets the types of some triangles, each to its new type, and the flags to match.
  struct Change {
    std::int32_t triangle;
    TriangleType type;
  };
  void change(std::span<const Change> changes, const BoundingVolumeTree& tree, Marks& marks,
              MarkingCounts& counts) const;

 protected:
  // Set flags on a leaf and upward, and clear them.
  virtual void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                    Marks& marks, MarkingCounts& counts) const;
  virtual void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                     Marks& marks, MarkingCounts& counts) const;

 private:
  // Makes the flags agree with the types of the triangles in marks.changed.
  void update(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts) const;
  // Does the same by one pass over all nodes, for types that have one flag each, as those of a
  // first search have.
  static void mark_anew(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts);
};

}  // namespace assay::detector
