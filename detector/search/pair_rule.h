// Which triangle pairs a step looks at, and the same question for two nodes of the tree.
//
// K = (V+,V-) u (U,V0) u (U,Vv) inside a component (L3; U are ALL triangles, those of V0 and Vv
// included), and every pair of two components (L10). Pairs that share a vertex or an edge count.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// The set that a triangle is in, or for a node the sets found below it.
namespace flag {
inline constexpr std::uint8_t positive = 1;  // P: V+
inline constexpr std::uint8_t negative = 2;  // N: V-
inline constexpr std::uint8_t zero = 4;      // Z: V0
inline constexpr std::uint8_t violated = 8;  // V: Vv, touched by a ghost or dirty
inline constexpr std::uint8_t grown = 16;    // besides: joined H in this round of the closure (L7)
inline constexpr int count = 5;
}  // namespace flag

// A symmetric relation between sets, answered for unions of sets by one look-up.
class PairTable {
 public:
  // Empty: asks for nothing.
  PairTable() = default;
  // Asks, or no longer asks, for the pairs of a triangle with flag `a` and one with flag `b`.
  PairTable& add(std::uint8_t a, std::uint8_t b);
  PairTable& remove(std::uint8_t a, std::uint8_t b);
  static PairTable everything();

  // Whether some flag of `a` and some flag of `b` are asked for.
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

// The tables of one search: for pairs of one component, and of two.
struct PairTables {
  PairTable within, across;
};

// The rule of the step (stage of the detector).
class PairRule {
 public:
  virtual ~PairRule() = default;
  // K inside a component, everything across.
  virtual PairTables candidates() const;
  // A round of the closure: what joined H against its whole component (U,H). Pairs across were all
  // looked at in the first round.
  virtual PairTables closure() const;
  // Whether triangle `t` joins H for a contact of its own component (L7: both do).
  virtual bool joins_closure(const TrianglePair& contact, std::int32_t t) const;
};

// Culling without views: every pair, and nothing left to close.
class EveryPair : public PairRule {
 public:
  PairTables candidates() const override;
};

}  // namespace assay::detector
