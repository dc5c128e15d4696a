// Writes a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// Writes PATH.part beside `path` and then renames it, so a reader sees the old file or the whole
// new one, and several writers may write the same file at the same time. If any of this fails, the
// problem states the system's reason, and nothing is left behind. What a killed writer leaves
// beside `path`, the next writer takes up. REQUIRES a file system that locks files (flock).
Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace assay::corpus
