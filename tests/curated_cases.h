// Reads the cases of corpus/curated. Each function throws if a case cannot be read. The cases of
// curated_cases() have no relation, because laws, state and most plug-ins are about all pairs.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::tests {

inline corpus::Case curated_case(const std::string& name) {
  return corpus::read_case(ASSAY_SOURCE_DIR "/corpus/curated/" + name + ".json").value();
}

inline std::vector<std::filesystem::path> curated_files() {
  return corpus::case_files(ASSAY_SOURCE_DIR "/corpus/curated").value();
}

inline std::vector<corpus::Case> curated_cases() {
  std::vector<corpus::Case> cases;
  for (const auto& file : curated_files()) {
    cases.push_back(corpus::read_case(file).value());
    cases.back().counted.reset();
  }
  return cases;
}

}  // namespace assay::tests
