// The failures of a run: their files, and what is printed of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/runner.h"

namespace assay::reports {

// OUT/shard-1-of-4.sqlite
std::filesystem::path store_file(const std::filesystem::path& out, const properties::Shard& shard);

// OUT/merged.sqlite
std::filesystem::path merged_file(const std::filesystem::path& out);

// The stores of trials in a folder, by name: of shards, and a merged one. One line in `problem`
// where there are none.
std::vector<std::filesystem::path> stored_shards(const std::filesystem::path& folder,
                                                 std::string& problem);

// Below OUT, the same in every run that finds it: failures/tiny-1-broken-3-bvh-smallest.json.
std::filesystem::path failure_file(const properties::StoredFailure& failure, bool smallest);

// "assay replay OUT/failures/... --detector LIB.so"
std::string replay_line(const std::filesystem::path& out, const std::filesystem::path& file,
                        const std::string& plugin);

struct FailureReport {
  std::string text;                    // a paragraph for each signature; empty without failures
  std::optional<std::string> problem;  // what could not be written
};

// Writes OUT/failures/CASE-CONFIGURATION-original.json and -smallest.json for each stored failure,
// under the same names in every run and shard, and a picture (.svg) of the smallest mesh of each
// signature. A failure is told once for each signature: claim,
// how often it was met, both sizes, triangles, feature, the line that replays it. plugin: the
// library that failed, or empty.
FailureReport write_failures(const properties::Store& store, const std::filesystem::path& out,
                             const std::string& plugin);

}  // namespace assay::reports
