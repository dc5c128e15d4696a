// The cases and waivers of a detector's owner: a folder that `run` and `certify` take beside what
// is shipped. The shipped waivers stand in corpus/known.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corpus/problem.h"
#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// The cases of such a folder: every file of it that ends with .json, except that of its waivers.
// Fails if one cannot be read, or if there is none.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// The file of waivers in such a folder, which is named as corpus/known.json is; nothing if there
// is none.
std::optional<std::filesystem::path> owner_waivers(const std::filesystem::path& folder);

// The cases of these files, or the first problem if one cannot be read.
corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files);

// SHA-256 over the names and bytes of these files.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

// A known failure that a certificate may leave aside for a while.
struct Waiver {
  std::string signature;  // of a failure, as `assay list failures` prints it
  std::string reason;
  std::string link;     // where it is being worked on
  std::string expires;  // the last day on which it holds, YYYY-MM-DD
};

// Reads a file of waivers, schema `assay-known/1` (corpus/README.md): {"schema", "waivers":
// [{signature, reason, link, expires}]}. Every field is stated and none is empty; each signature
// occurs once.
corpus::Expected<std::vector<Waiver>> read_waivers(const std::filesystem::path& file);

// `today` is YYYY-MM-DD.
bool is_expired(const Waiver& waiver, const std::string& today);

}  // namespace assay::reports
