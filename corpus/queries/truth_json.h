// Truths of a query set: a JSON array of booleans.
#pragma once

#include <filesystem>
#include <vector>

#include "corpus/problem.h"

namespace assay::corpus {

// Refuses what read_bytes and parse_json refuse, and what is not an array of booleans.
Expected<std::vector<bool>> read_truths(const std::filesystem::path& path);

}  // namespace assay::corpus
