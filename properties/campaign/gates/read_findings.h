// Reads the stores of a folder into findings. This is done here and nowhere else.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "properties/campaign/database/rows.h"
#include "properties/campaign/gates/findings.h"

namespace assay::properties {

// The rows that a process knows of the stores of a folder, because it wrote them or found them
// when it began. The keys are the names of the files, without their folder.
using KnownRows = std::map<std::string, const RowTally*>;

// Reads one store alone. The problems are those of Store::read, and not_as_stored if `known` is
// given and the store does not hold exactly these rows.
Expected<RunFindings> read_one_store(const std::filesystem::path& file,
                                     const RowTally* known = nullptr);

// Reads merged.sqlite if there is one, else every shard-*.sqlite, and checks.sqlite. O(trials).
//
// Problems besides those of Store::read: no_run if there is nothing; another_run and contradiction
// if two files do not belong together; wrong_shards; stale_merge; damaged_store, also for a trial
// that its shard does not plan; not_as_stored if `known` is not empty and the folder does not hold
// exactly these stores, each with exactly its rows.
Expected<RunFindings> read_findings(const std::filesystem::path& folder,
                                    const KnownRows& known = {});

}  // namespace assay::properties
