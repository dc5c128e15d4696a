// The child processes of a test, as the system knows them.
#pragma once

#include <unistd.h>

#include "tests/test.h"

namespace assay::properties::test {

// Processes whose parent is this one, dead ones that nobody has waited for included.
inline std::vector<int> children() {
  std::vector<int> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line == "PPid:\t" + std::to_string(getpid())) found.push_back(std::stoi(name));
    }
  }
  return found;
}

}  // namespace assay::properties::test
