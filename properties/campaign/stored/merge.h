// Stores of several shards of one campaign become one.
#pragma once

#include <filesystem>
#include <span>

#include "properties/problem.h"

namespace assay::properties {

// Writes `out` anew from all that `stores` hold, and from what `out` holds when it is there. What
// is written depends on the rows alone: the order of merging does not matter, nor does merging
// again; equal rows give equal bytes. `out` is whole or as it was, whatever happens.
//
// Nothing is written on a problem. another_run: two stores are of different runs (plan, seed,
// detector, digests: all of the binding but the shard). contradiction: one trial has two outcomes,
// one failure two meshes, or one piece of evidence two results at equal progress. cannot_write, and
// the problems of Store::read. Of what may rightly differ the smaller is taken: times of a trial,
// shrunk meshes; of evidence the one with more progress; such rows get a new hash, all others keep
// theirs, and changed_row names the first that does not fit it. A store that is being written is
// merged as it is now. Two merges do not write into one folder at a time: busy.
Expected<void> merge_stores(std::span<const std::filesystem::path> stores,
                            const std::filesystem::path& out);

}  // namespace assay::properties
