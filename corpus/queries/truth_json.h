// Truths of a query set: a JSON array of booleans.
#pragma once

#include <filesystem>
#include <vector>

#include "corpus/problem.h"

namespace assay::corpus {

// Problems: those of read_bytes and parse_json; wrong_type when it is not an array of booleans.
Expected<std::vector<bool>> read_truths(const std::filesystem::path& path);

}  // namespace assay::corpus
