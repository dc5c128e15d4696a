// Where the cases of a corpus lie: what is shipped with the program, and a folder of the detector's
// owner, which `run` and `certify` take beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/campaign/request.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// The folder of the shipped corpus: curated cases, known failures, the conformance set. It lies
// beside the program, as that was built or installed, so the program holds no path of another
// machine. The environment variable ASSAY_CORPUS names another folder. Fails if there is none.
Expected<std::filesystem::path> shipped_corpus();

// The cases of a folder of the owner: every file of it that ends with .json.
// Fails if one cannot be read, or if there is none.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// The cases of these files, or the first problem if one cannot be read.
corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files);

// SHA-256 over the names and bytes of these files.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace assay::reports
