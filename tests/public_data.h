// The folder of the public data. A test that reads it says so: its suite or its name begins with
// `Public` (tests/house), and tests/without_data.py sees that it is skipped where there is no data.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace assay::tests {

// What ASSAY_DATA names; nothing where it is not set, empty or no folder.
inline const char* public_data() {
  const char* folder = std::getenv("ASSAY_DATA");
  return folder && std::filesystem::is_directory(folder) ? folder : nullptr;
}

}  // namespace assay::tests
