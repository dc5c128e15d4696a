// Writes a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// Writes beside `path` and renames: whoever reads sees the old file or the whole new one.
// cannot_write, with the system's reason, when any of it fails; nothing is left behind then.
Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace assay::corpus
