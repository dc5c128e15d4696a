// Writes a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// Writes beside `path` (PATH.part) and renames: whoever reads sees the old file or the whole new
// one, and several may write it at the same time. cannot_write, with the system's reason, when any
// of it fails; nothing is left behind then. What a killed writer leaves beside `path` the next one
// takes up. REQUIRES a file system that locks files (flock).
Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace assay::corpus
