// The files of a run's folder, by their names.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"

namespace assay::properties {

// OUT/shard-1-of-4.sqlite
std::filesystem::path store_file(const std::filesystem::path& out, const Shard& shard);
// OUT/merged.sqlite
inline std::filesystem::path merged_file(const std::filesystem::path& out) {
  return out / "merged.sqlite";
}
// OUT/checks.sqlite: what `assay certify` finds out by itself.
inline std::filesystem::path checks_file(const std::filesystem::path& out) {
  return out / "checks.sqlite";
}
// OUT/campaign.json, OUT/certificate.json
inline std::filesystem::path campaign_file(const std::filesystem::path& out) {
  return out / "campaign.json";
}
inline std::filesystem::path certificate_file(const std::filesystem::path& out) {
  return out / "certificate.json";
}

// The stores of trials in a folder, in the order of their names: those of shards, and a merged
// one. Fails if there are none, or if the folder cannot be listed.
Expected<std::vector<std::filesystem::path>> stored_shards(const std::filesystem::path& folder);

// A shard's store as a certificate takes it.
struct WholeShard {
  std::uint64_t trials = 0;
  KeptFailures failures;
};
// Checks every row of the store and seals its file. Fails if it belongs to another run than the
// request, its shard aside, and where Store::read and Store::open fail.
Expected<WholeShard> make_whole(const std::filesystem::path& file, const CampaignRequest& request);

// Stores the path of a plug-in's library, as it was named to the run, and finds it again (nothing
// if none was stored). Both throw StoreProblem, and are for campaign/ alone.
void note_library(Store& store, const CampaignRequest& request);
std::optional<std::string> noted_library(const Store& store);

// Now, in UTC: 2026-01-31T12:00:00Z. No verdict rests on it.
std::string time_in_utc();

// Stores when the run was begun, unless that is stored already, and finds it again. Of several
// stores that are merged, the earliest stays. Both throw StoreProblem, as above.
void note_begin(Store& store);
std::optional<std::string> noted_begin(const Store& store);

// The file of a failure below OUT, the same in every run that finds the failure:
// failures/tiny-1-broken-3-bvh-smallest.json.
std::filesystem::path failure_file(const StoredFailure& failure, bool smallest);

// checks.sqlite, in which `assay certify` stores what it finds out by itself as soon as it is
// known.
//
// It is used like an output stream: after the first problem nothing more is stored. Whoever writes
// asks problem() before starting work that would then be in vain.
class Checks {
 public:
  // Opens OUT/checks.sqlite, bound to the request; the problems are those of Store::open.
  static Expected<Checks> open(const std::filesystem::path& out, const CampaignRequest& request);

  // Stores a struct of evidence.h.
  template <class T>
  void keep(const T& evidence) {
    update([&](Store& store) { store.set(to_row(evidence)); });
  }
  // Removes what an earlier run stored of a kind (its `kind`), before the same work is done again.
  void drop(std::string_view kind);
  // Removes the stored failures whose signature is not in the set.
  void keep_failures(const std::set<std::string>& signatures);
  // See Store::seal.
  void seal();
  // The stored failures, or the first problem.
  Expected<KeptFailures> failures() const;

  // Does work that may throw StoreProblem, unless there was a problem before. For campaign/ alone.
  void update(const std::function<void(Store&)>& work);

  // The first problem, if any.
  const std::optional<Problem>& problem() const { return problem_; }

 private:
  explicit Checks(Store store) : store_(std::move(store)) {}
  Store store_;
  std::optional<Problem> problem_;
};

}  // namespace assay::properties
