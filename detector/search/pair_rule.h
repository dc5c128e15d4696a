// Which triangle pairs a step looks at, and which pairs of tree nodes may hold such pairs.
//
// Inside a component these are the pairs of K = (V+,V-) u (U,V0) u (U,Vv) (L3; U are ALL
// triangles, those of V0 and Vv included). Between two components they are all pairs (L10). Pairs
// that share a vertex or an edge are looked at too.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  // Ask, or no longer ask, for the pairs of a triangle with flag `a` and one with flag `b`.
  PairTable& add(std::uint8_t a, std::uint8_t b);
  PairTable& remove(std::uint8_t a, std::uint8_t b);
  static PairTable everything();

  // Whether some flag of `a` is asked for together with some flag of `b`.
  bool asks(std::uint8_t a, std::uint8_t b) const { return (partners_[a] & b) != 0; }
  // The flags that some flag of `a` asks for.
  std::uint8_t partners(std::uint8_t a) const { return partners_[a]; }
  // Asks for what either of the two asks for.
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
  // For the first search: K inside a component, every pair of two components.
  virtual PairTables candidates() const;
  // For a round of the closure: what has joined H against its whole component (U,H). No pair of
  // two components is asked for, because the first search looked at all of them.
  virtual PairTables closure() const;
  // Whether triangle `t` of this contact, which is within one component, joins H. In L7 both of
  // its triangles do.
  virtual bool joins_closure(const TrianglePair& contact, std::int32_t t) const;
};

// The rule of cullings without views: it asks for every pair, so nothing is left to close.
class EveryPair : public PairRule {
 public:
  PairTables candidates() const override;
};

}  // namespace assay::detector
