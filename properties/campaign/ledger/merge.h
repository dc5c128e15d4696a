// Makes one store of the stores of several shards of one campaign.
#pragma once

#include <filesystem>
#include <span>

#include "properties/problem.h"

namespace assay::properties {

// Writes `out` anew from all that `stores` hold, and from what `out` held before, if it is there.
// The result depends on the rows alone: neither the order of merging nor merging again changes it,
// and equal rows give equal bytes. Whatever happens, `out` is either whole or as it was.
//
// A store that is being written is merged as it is now. If two stores rightly differ, the smaller
// value is taken of a trial's times and of shrunk meshes, and of evidence the one with more
// progress. Such rows get a new hash; all others keep theirs.
//
// If there is a problem, nothing is written. It is one:
// - if two stores belong to different runs (plan, seed, detector, digests: all of the binding but
//   the shard).
// - if one trial has two outcomes, one failure two meshes, or one piece of evidence two results at
//   equal progress.
// - if a row does not fit its hash. The first one is named.
// - if another merge is writing into the same folder, or the result cannot be written.
// - if Store::read fails.
Expected<void> merge_stores(std::span<const std::filesystem::path> stores,
                            const std::filesystem::path& out);

}  // namespace assay::properties
