#include "reports/certificate/corpus_failures.h"

#include <chrono>
#include <map>

#include "properties/campaign/phases/phases.h"
#include "properties/campaign/phases/shrink.h"
#include "properties/campaign/stored/run_folder.h"
#include "reports/terminal/plain_progress.h"

namespace assay::reports {

using properties::Store;
using properties::StoredFailure;

std::set<std::string> signatures_of_trials(const std::filesystem::path& out) {
  std::set<std::string> signatures;
  std::string problem;
  for (const auto& file : properties::stored_shards(out, problem)) {
    const auto store = Store::read(file, problem);
    if (!store) continue;  // told where the stores are read for the certificate
    for (const auto& failure : store->failures()) signatures.insert(failure.signature);
  }
  return signatures;
}

void keep_corpus_failures(const properties::CampaignRequest& request,
                          const std::vector<StoredFailure>& failures,
                          const std::set<std::string>& known, Store& checks) {
  auto told = known;
  for (const auto& stored : checks.failures()) told.insert(stored.signature);
  std::map<std::string, const StoredFailure*> smallest;
  for (const auto& failure : failures) {
    if (told.contains(failure.signature)) continue;
    const auto*& best = smallest[failure.signature];
    if (!best || failure.mesh.size() < best->mesh.size()) best = &failure;
  }
  for (const auto& [signature, failure] : smallest) checks.add(*failure);
  using Clock = std::chrono::steady_clock;
  PlainProgress progress("shrinking");
  constexpr double seconds_each = 60;
  properties::shrink_failures(
      request, checks, {seconds_each, 1'000'000},
      properties::deadline_in(Clock::now(), properties::shrinking_seconds(request.plan)),
      [&](const std::string& text) { progress.show(text); });
}

}  // namespace assay::reports
