// Cases and waivers of whoever owns a detector: a folder that `run` and `certify` take beside what
// is shipped.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// The cases of such a folder: every file of it that ends with .json but that of its
// waivers. Refused where one cannot be read, or there is none.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// The file of waivers in such a folder, named as corpus/known.json is; nothing where there is none.
std::optional<std::filesystem::path> owner_waivers(const std::filesystem::path& folder);

// The cases of these files; the first problem where one cannot be read.
corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files);

// SHA-256 over their names and bytes.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace assay::reports
