// Broad phase: triangle pairs whose swept boxes meet and that the pair rule asks for.
#pragma once

#include <functional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/search/pair_rule.h"

namespace assay::detector {

struct SearchCounts {
  std::uint64_t box_tests = 0;
  std::uint64_t candidate_pairs = 0;
};

// Takes a candidate pair (any order); false: stop the search.
using PairSink = std::function<bool(std::int32_t, std::int32_t)>;

// Descends the refitted tree against itself. Returns false when the sink stopped it.
bool search_pairs(const BoundingVolumeTree& tree, const Marks& marks, PairRule rule,
                  SearchCounts& counts, const PairSink& sink);

// The same pairs without a tree and without boxes: every pair that the rule asks for. O(M^2).
bool enumerate_pairs(const Topology& mesh, const Marks& marks, PairRule rule, SearchCounts& counts,
                     const PairSink& sink);

}  // namespace assay::detector
