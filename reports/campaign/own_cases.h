// The cases of a detector's owner: a folder that `run` and `certify` take beside what is shipped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// The cases of such a folder: every file of it that ends with .json.
// Fails if one cannot be read, or if there is none.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// The cases of these files, or the first problem if one cannot be read.
corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files);

// SHA-256 over the names and bytes of these files.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace assay::reports
