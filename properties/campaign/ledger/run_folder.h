// The files of a run's folder, by their names.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"

namespace assay::properties {

// OUT/run.sqlite
inline std::filesystem::path store_file(const std::filesystem::path& out) {
  return out / "run.sqlite";
}
// OUT/seed-7.sqlite: the copy of a run's store in a folder where several runs are judged together.
std::filesystem::path copied_store_file(const std::filesystem::path& out, std::uint64_t seed);
// OUT/campaign.json, OUT/certificate.json
inline std::filesystem::path campaign_file(const std::filesystem::path& out) {
  return out / "campaign.json";
}
inline std::filesystem::path certificate_file(const std::filesystem::path& out) {
  return out / "certificate.json";
}

// The stores in a folder, in the order of their names. Fails if there are none, or if the folder
// cannot be listed.
Expected<std::vector<std::filesystem::path>> stored_runs(const std::filesystem::path& folder);

// Fails if the folder holds another store than these: all stores of a folder are judged together.
Expected<void> expect_no_other_store(const std::filesystem::path& folder,
                                     const std::set<std::filesystem::path>& expected);

// The notes of a store in which these stand: the path of a plug-in's library, as it was named to
// the run, and when the run was begun. Both functions throw StoreProblem, and are for campaign/
// alone; a time that is stored already stays.
inline constexpr const char *library_note = "library", *begin_note = "begun";
void note_library(Store& store, const CampaignRequest& request);
void note_begin(Store& store);

// Now, in UTC: 2026-01-31T12:00:00Z. No verdict rests on it.
std::string time_in_utc();

// The file of a failure below OUT, the same in every run that finds the failure:
// failures/tiny-1-broken-3-bvh-smallest.json.
std::filesystem::path failure_file(const StoredFailure& failure, bool smallest);

}  // namespace assay::properties
