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

// Stores what `assay certify` finds out by itself beside the trials, as soon as it is known.
//
// It is used like an output stream: after the first problem nothing more is stored. Whoever writes
// asks problem() before starting work that would then be in vain.
class Checks {
 public:
  explicit Checks(Store& store) : store_(store) {}

  // Stores a struct of evidence.h.
  template <class T>
  void keep(const T& evidence) {
    update([&](Store& store) { store.set(to_row(evidence)); });
  }
  // Removes what an earlier run stored of a kind (its `kind`), before the same work is done again.
  void drop(std::string_view kind);
  // Removes the stored failures of the corpus whose signature is not in the set.
  void keep_corpus_failures(const std::set<std::string>& signatures);
  // The stored failures of the corpus, or the first problem.
  Expected<KeptFailures> corpus_failures() const;

  // Does work that may throw StoreProblem, unless there was a problem before. For campaign/ alone.
  void update(const std::function<void(Store&)>& work);

  // The first problem, if any.
  const std::optional<Problem>& problem() const { return problem_; }

 private:
  Store& store_;
  std::optional<Problem> problem_;
};

}  // namespace assay::properties
