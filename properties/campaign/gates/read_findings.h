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

// Reads one store alone. Fails as Store::read does; the kind is not_as_stored if `known` is given
// and the store does not hold exactly these rows.
Expected<RunFindings> read_one_store(const std::filesystem::path& file,
                                     const RowTally* known = nullptr);

// Reads merged.sqlite if there is one, else every shard-*.sqlite, and checks.sqlite. O(trials).
//
// Refuses, besides what Store::read refuses: a folder without a run; two files that do not belong
// together; a shard that is there twice, or of another number of shards; a merged store beside
// which a shard holds more; a trial that its shard does not plan. The kind is not_as_stored if
// `known` is not empty and the folder does not hold exactly these stores, each with exactly its
// rows.
Expected<RunFindings> read_findings(const std::filesystem::path& folder,
                                    const KnownRows& known = {});

}  // namespace assay::properties
