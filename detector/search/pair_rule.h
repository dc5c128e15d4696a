// Which triangle pairs a step has to look at, and the same question for two nodes of the tree.
//
// K = (V+,V-) u (U,V0) u (U,Vv) inside a component (L3; U are ALL triangles, those of V0 and Vv
// included), and every pair of two components (L10). Pairs that share a vertex or an edge count.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/search/bounding_volume_tree.h"

namespace assay::detector {

// Flags of a triangle, or of all triangles below a node.
namespace flag {
inline constexpr std::uint8_t positive = 1;  // V+
inline constexpr std::uint8_t negative = 2;  // V-
inline constexpr std::uint8_t full = 4;      // V0 or Vv: against everything
inline constexpr std::uint8_t grown = 8;     // joined H in this round of the closure (L7)
}  // namespace flag

struct Marks {
  std::vector<std::uint8_t> triangle_flags;
  std::vector<std::uint8_t> node_flags;
  std::vector<std::int32_t> node_component;  // one component below the node, or mixed_components
};
inline constexpr std::int32_t mixed_components = -1;

// node_flags and node_component from the triangles' flags. O(M).
void mark_nodes(const BoundingVolumeTree& tree, const Topology& mesh, Marks& marks);

enum class PairRule : std::uint8_t {
  every_pair,        // no culling by views
  candidates,        // K, and every pair of two components
  grown,             // a triangle that joined H, against its whole component (L7)
  within_component,  // a triangle with `full`, against its whole component (start, L9)
};

// Whether some pair below the two (possibly equal) nodes may be asked for.
inline bool may_hold_pair(PairRule rule, std::uint8_t a, std::uint8_t b, bool same_component) {
  switch (rule) {
    case PairRule::every_pair:
      return true;
    case PairRule::candidates:
      return !same_component || ((a | b) & flag::full) ||
             ((a & flag::positive) && (b & flag::negative)) ||
             ((a & flag::negative) && (b & flag::positive));
    case PairRule::grown:
      // Pairs of two components were all looked at in the first round.
      return same_component && ((a | b) & flag::grown);
    case PairRule::within_component:
      return same_component && ((a | b) & flag::full);
  }
  return true;
}

}  // namespace assay::detector
