// Broad phase: triangle pairs whose swept boxes meet and that the pair rule asks for.
#pragma once

#include <functional>
#include <vector>

#include "detector/search/bounding_volume_tree.h"
#include "detector/search/pair_rule.h"

namespace assay::detector {

struct SearchCounts {
  std::uint64_t box_tests = 0;
  std::uint64_t candidate_pairs = 0;
};

// Flags of all triangles, and what follows of them for the nodes of the tree.
struct Marks {
  std::vector<std::uint8_t> triangle_flags;
  std::vector<std::uint8_t> node_flags;
  std::vector<std::int32_t> node_component;  // one component below the node, or mixed_components
};
inline constexpr std::int32_t mixed_components = -1;

// node_flags and node_component from the triangles' flags. O(M).
void mark_nodes(const BoundingVolumeTree& tree, const Topology& mesh, Marks& marks);

// Takes a candidate pair (any order); false: stop the search.
using PairSink = std::function<bool(std::int32_t, std::int32_t)>;

struct SearchInput {
  const Topology& mesh;
  const BoundingVolumeTree& tree;  // fitted to the step
  Marks& marks;                    // triangle_flags are set; the rest is the search's own
  const PairTables& tables;
};

// A stage of the detector; returns false when the sink stopped it.
class PairSearch {
 public:
  virtual ~PairSearch() = default;
  // Brings the tree to a step, before the searches of that step.
  virtual void fit(BoundingVolumeTree& tree, const Topology& mesh, const PositionsView& x_t0,
                   const PositionsView& x_t1) const {
    tree.refit(mesh, x_t0, x_t1);
  }
  virtual bool search(const SearchInput& input, SearchCounts& counts,
                      const PairSink& sink) const = 0;
};

// Descends the tree against itself.
class TreeSearch : public PairSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

// Looks at every pair, without boxes. O(M^2).
class ExhaustiveSearch : public PairSearch {
 public:
  void fit(BoundingVolumeTree&, const Topology&, const PositionsView&,
           const PositionsView&) const override {}
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

// Triangles whose box meets `box`, a single descent; false when the sink stopped it.
bool search_box(const BoundingVolumeTree& tree, const Box& box, SearchCounts& counts,
                const std::function<bool(std::int32_t)>& sink);

}  // namespace assay::detector
