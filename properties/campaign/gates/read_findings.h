// The stores of a folder, read into findings: here and nowhere else.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "properties/campaign/database/rows.h"
#include "properties/campaign/gates/findings.h"

namespace assay::properties {

// What a process knows of the stores of a folder, for it wrote them or found them when it began: by
// the name of the file, without its folder.
using KnownRows = std::map<std::string, const RowTally*>;

// Of one store alone; the problems are those of Store::read. known: not_as_stored where the store
// does not hold these rows and no others.
Expected<RunFindings> read_one_store(const std::filesystem::path& file,
                                     const RowTally* known = nullptr);

// Reads merged.sqlite where there is one, else every shard-*.sqlite, and checks.sqlite. Besides the
// problems of Store::read: no_run where there is nothing; another_run and contradiction where two
// files do not belong together; wrong_shards; stale_merge; damaged_store, also for a trial that is
// none which its shard plans. known: not_as_stored where the stores of the folder are others than
// these, or one of them does not hold its rows and no others; nothing is asked where it is empty.
// O(trials).
Expected<RunFindings> read_findings(const std::filesystem::path& folder,
                                    const KnownRows& known = {});

}  // namespace assay::properties
