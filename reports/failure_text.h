// The failures of a run: their files, and what is printed of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "properties/campaign/runner.h"

namespace assay::reports {

// OUT/shard-1-of-4.sqlite
std::filesystem::path store_file(const std::filesystem::path& out, const properties::Shard& shard);

// Where the meshes of a failure stand, the same in every run that finds it.
std::filesystem::path original_file(const std::filesystem::path& out,
                                    const properties::StoredFailure& failure);
std::filesystem::path smallest_file(const std::filesystem::path& out,
                                    const properties::StoredFailure& failure);

// "assay replay FILE --detector LIB.so", of the smallest mesh that there is.
std::string replay_line(const std::filesystem::path& out, const properties::StoredFailure& failure,
                        const std::string& library);

struct FailureReport {
  std::string text;                    // a paragraph for each signature; empty without failures
  std::optional<std::string> problem;  // what could not be written
};

// Writes OUT/failures/CASE-CONFIGURATION-original.json and -smallest.json for each stored failure,
// under the same names in every run and shard, and a picture (.svg) of the smallest mesh of each
// signature. A failure is told once for each signature: claim,
// how often it was met, both sizes, triangles, feature, the line that replays it.
FailureReport write_failures(const properties::Store& store, const std::filesystem::path& out,
                             const properties::CampaignRequest& request);

}  // namespace assay::reports
