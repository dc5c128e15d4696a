#include "properties/campaign/phases/corpus_failures.h"

#include <map>
#include <set>

#include "properties/campaign/database/store_problem.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/phases/shrink.h"
#include "properties/campaign/stored/run_folder.h"

namespace assay::properties {
namespace {

// The signatures of the failures in the shards of a folder and in its merged store.
std::set<std::string> signatures_of_trials(const std::filesystem::path& out) {
  std::set<std::string> signatures;
  const auto files = stored_shards(out);
  if (!files) return signatures;
  for (const auto& file : files.value()) {
    const auto failures = read_failures(file);
    if (!failures) continue;  // it is reported when the stores are read for the certificate
    for (const auto& failure : failures.value().list) signatures.insert(failure.signature);
  }
  return signatures;
}

// For each signature that is not in `told`: the failure with the smallest mesh, by the length of
// its text.
std::map<std::string, const StoredFailure*> smallest_of(const std::vector<StoredFailure>& failures,
                                                        const std::set<std::string>& told) {
  std::map<std::string, const StoredFailure*> smallest;
  for (const auto& failure : failures) {
    if (told.contains(failure.signature)) continue;
    const auto*& best = smallest[failure.signature];
    if (!best || failure.mesh.size() < best->mesh.size()) best = &failure;
  }
  return smallest;
}

}  // namespace

void keep_corpus_failures(const CampaignRequest& request,
                          const std::vector<StoredFailure>& failures,
                          const std::filesystem::path& out, Checks& checks,
                          const std::function<void(const std::string&)>& progress) {
  checks.update([&](Store& store) {
    auto told = signatures_of_trials(out);
    for (const auto& stored : store.failures()) told.insert(stored.signature);
    for (const auto& [signature, failure] : smallest_of(failures, told)) store.add(*failure);
    constexpr ReduceLimits shrinking_of_one{60, 1'000'000};
    shrink_failures(request, store, shrinking_of_one,
                    deadline_in(std::chrono::steady_clock::now(), shrinking_seconds(request.plan)),
                    progress);
  });
}

Expected<void> keep_own_cases(Store& store, const std::vector<CorpusRow>& rows,
                              const std::vector<StoredFailure>& failures) {
  return catch_store_problem([&] {
    for (const auto& row : rows) store.set(to_row(row));
    std::set<std::string> told;
    for (const auto& stored : store.failures()) told.insert(stored.signature);
    for (const auto& [signature, failure] : smallest_of(failures, told)) store.add(*failure);
  });
}

}  // namespace assay::properties
