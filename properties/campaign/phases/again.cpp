#include "properties/campaign/phases/again.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/random.h"
#include "properties/worker/isolation/scratch_folder.h"

namespace assay::properties {
namespace {

// Chooses `chosen` of the numbers below `all`, each equally likely. This is Floyd's algorithm,
// which needs only as many random numbers as it chooses.
std::set<std::uint64_t> choose(std::uint64_t chosen, std::uint64_t all, std::uint64_t seed) {
  Random random(seed, 0);
  std::set<std::uint64_t> numbers;
  for (std::uint64_t i = all - chosen; i < all; ++i) {
    const std::uint64_t number = random.next() % (i + 1);
    if (!numbers.insert(number).second) numbers.insert(i);
  }
  return numbers;
}

// Draws trials of a store, in the order of their families and places. `number` counts the trials of
// all stores.
std::vector<TrialRecord> draw(const Store& store, const std::set<std::uint64_t>& numbers,
                              std::uint64_t& number) {
  std::vector<TrialRecord> drawn;
  store.for_each_trial([&](const TrialRecord& record) {
    if (numbers.contains(number++)) drawn.push_back(record);
  });
  return drawn;
}

// Names the first thing in which the two trials differ. Empty if they do not differ.
std::string difference_of_trials(const TrialRecord& stored, const TrialRecord& now,
                                 const DetectorUnderTest& detector) {
  for (std::size_t c = 0; c < detector.configurations.size(); ++c) {
    const auto letter = [&](const TrialRecord& record) {
      return c < record.outcomes.size() ? std::string(1, record.outcomes[c]) : "nothing";
    };
    if (letter(stored) != letter(now))
      return fmt::format("{} is {} now, {} is stored", detector.configurations[c].name, letter(now),
                         letter(stored));
  }
  const auto of = [&](const char* counted, std::uint64_t there, std::uint64_t here) {
    return fmt::format("{} {} now, {} stored", here, counted, there);
  };
  if (stored.triangles != now.triangles) return of("triangles", stored.triangles, now.triangles);
  if (stored.steps != now.steps) return of("steps", stored.steps, now.steps);
  if (stored.collisions != now.collisions)
    return of("collisions", stored.collisions, now.collisions);
  if (stored.pairs != now.pairs) return of("pairs", stored.pairs, now.pairs);
  if (stored.mesh != now.mesh) return "its mesh is another one";
  if (stored.outcomes != now.outcomes) return "outcomes of more configurations than there are";
  if (stored.counts != now.counts) return "its counts are others";
  return "";
}

// Runs the trials of one store once more. Names the first that comes to something else; empty if
// none does.
std::string difference_of_store(const CampaignRequest& request,
                                const std::vector<TrialRecord>& drawn,
                                const std::function<void(const TrialProgress&)>& progress) {
  std::set<std::string> ids;
  for (const auto& record : drawn) ids.insert(record.id);
  const ScratchFolder scratch = value_or_throw(ScratchFolder::make());
  Store store = value_or_throw(Store::open(scratch.path() / "again", binding_of(request)));
  const auto end = run_trials(request, store, RunDeadline::max(), progress, &ids);
  if (end.problem) throw StoreProblem(*end.problem);
  if (!end.harness_problem.empty()) throw StoreProblem(end.harness_problem);
  std::map<std::string, TrialRecord> now;
  store.for_each_trial([&](const TrialRecord& record) { now[record.id] = record; });
  for (const auto& record : drawn) {
    const auto found = now.find(record.id);
    const auto difference = found == now.end()
                                ? std::string("the campaign has no such trial")
                                : difference_of_trials(record, found->second,
                                                       request.detector.in_stratum(record.family));
    if (!difference.empty()) return fmt::format("trial {}: {}", record.id, difference);
  }
  return "";
}

}  // namespace

Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed,
                                const std::function<void(const TrialProgress&)>& progress) {
  return catch_store_problem([&] {
    const auto files = value_or_throw(stored_runs(folder));
    TrialsAgain again;
    for (const auto& file : files) again.stored += value_or_throw(Store::read(file)).trial_count();
    if (again.stored == 0)
      throw StoreProblem(fmt::format("{}: no trial is stored here", folder.string()));
    const auto wanted = std::ceil(share * static_cast<double>(again.stored));
    again.trials = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(wanted), 1, again.stored);
    const auto numbers = choose(again.trials, again.stored, seed);
    std::uint64_t number = 0;
    for (const auto& file : files) {
      const Store store = value_or_throw(Store::read(file));
      const auto drawn = draw(store, numbers, number);
      if (drawn.empty()) continue;
      const auto run = value_or_throw(read_binding(store.binding(), file));
      request.seed = run.seed;
      request.shares = run.shares;
      const auto difference = difference_of_store(request, drawn, progress);
      if (difference.empty()) continue;
      again.difference = difference;
      break;
    }
    return again;
  });
}

}  // namespace assay::properties
