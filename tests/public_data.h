// The folder of the public data. If a test reads this data, its suite or its name begins with
// `Public` (tests/house). tests/without_data.py checks that such a test is skipped without the
// data.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace assay::tests {

// Returns the folder that ASSAY_DATA names; null if the variable is not set, is empty or names no
// folder.
inline const char* public_data() {
  const char* folder = std::getenv("ASSAY_DATA");
  return folder && std::filesystem::is_directory(folder) ? folder : nullptr;
}

}  // namespace assay::tests
