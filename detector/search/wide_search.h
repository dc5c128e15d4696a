// The broad phase on wide nodes (wide_tree.h): the same candidates as TreeSearch, in less time.
#pragma once

#include "detector/search/pair_search.h"

namespace assay::detector {

// Descends the wide tree against itself. The flags of two nodes say which pairs of their children
// may hold a pair that is asked for; of these, vector instructions compare the boxes of one child
// with up to eight others at once. No single-child node is passed over: a comparison costs less
// than to find out.
//
// If the pace has workers, the descent is cut into pairs of nodes near the root, and each worker
// takes one of these after the other (TreeSearch). Candidates and counts are the same for any
// number of workers and any instruction set.
class WideSearch : public PairSearch {
 public:
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override;
};

}  // namespace assay::detector
