#include "properties/campaign/phases/phases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/database.h"
#include "properties/random.h"
#include "properties/worker/isolation.h"
#include "properties/worlds/tetrahedron_world.h"

namespace assay::properties {
namespace {

using Clock = std::chrono::steady_clock;

// A phase must be over when this share of the plan's time has passed. If trials are missing, they
// have all but a tenth of the time. In this tenth their failures are shrunk, and nothing else is
// begun. The same command goes on with the rest.
constexpr double trials_share = 0.9, faults_share = 0.95;

// The limits for shrinking a single failure.
constexpr ReduceLimits shrinking_of_one{60, 1'000'000};

// The phases of run_campaign(), which states their order.
struct CampaignRun {
  const CampaignRequest& request_;
  const std::filesystem::path& corpus_;
  Store& store_;
  CampaignObserver& observer_;
  const OnText progress_ = [this](const std::string& text) { observer_.on_progress(text, 0, 0); };
  const RunDeadline begin_ = Clock::now();

  // Notes the isolation of all trials that the store holds, including those of an earlier call.
  void note_isolation() {
    PluginIsolation now{request_.isolation_word(), name_of(request_.isolation)};
    for (const auto& before : facts().isolation) {
      if (store_.trial_count() > 0 && before.got == name_of(Isolation::limits))
        now.got = before.got;
    }
    store_.set(to_row(now));
  }

  RunDeadline after(double share) const { return deadline_after(begin_, request_.plan, share); }

  static RunDeadline earlier(RunDeadline deadline, double seconds_from_now) {
    return std::min(deadline, deadline_in(Clock::now(), seconds_from_now));
  }

  // Shrinks failures. The tenth of the time for this begins when the trials have ended, however
  // late.
  void shrink(bool complete) {
    const double most = shrinking_seconds(request_.plan), all = request_.plan.seconds;
    const double seconds = all == 0 ? most : std::min(most, (1 - trials_share) * all);
    shrink_failures(request_, store_, shrinking_of_one,
                    complete ? earlier(after(1), most) : deadline_in(Clock::now(), seconds),
                    progress_);
  }

  // Returns the evidence that an earlier call of this run stored.
  EvidenceFacts facts() const { return facts_in(store_); }

  void drop_proofs() {
    store_.drop(PowerSource::kind);
    store_.drop(FaultProof::kind);
  }

  // Takes over the proof. If an earlier call of this run proved planted faults by itself, its
  // proofs are dropped, because a store never holds both kinds.
  void take_power() {
    if (facts().power.empty()) drop_proofs();
    store_.set(to_row(request_.power->source));
    for (const auto& proof : request_.power->faults) store_.set(to_row(proof));
  }

  void hunt() {
    const auto& plan = request_.plan;
    const auto before = facts();
    if (!before.power.empty()) {
      drop_proofs();
    } else if (!before.faults.empty() &&
               std::ranges::none_of(before.faults,
                                    [](const FaultProof& proof) { return proof.time_over; })) {
      return;
    }
    const FaultHunt hunt{plan.name,        request_.seed,
                         plan.fault_seeds, share_of(plan.fault_cases, request_.shares),
                         request_.jobs,    corpus_};
    const auto proofs = hunt_faults(
        hunt, after(faults_share),
        [&](const auto& text, auto count, auto rest) { observer_.on_progress(text, count, rest); });
    for (const auto& proof : proofs) store_.set(to_row(proof));
  }

  void explore_worlds() {
    const auto end = earlier(after(1), request_.plan.tetrahedron_seconds);
    for (const auto& world : tetrahedron_worlds()) {
      const double rest = std::chrono::duration<double>(end - Clock::now()).count();
      if (rest <= 0) break;
      progress_(fmt::format("{}: every motion of a tetrahedron on a small grid", world.name));
      const auto result = prove(world, {request_.jobs, rest, {}});
      store_.set(
          to_row(World{world.name, result.classes, result.motions, result.all, result.collisions,
                       result.complete,
                       result.counterexample ? std::optional(result.explanation) : std::nullopt}));
    }
  }
};

}  // namespace

Expected<void> run_campaign(const CampaignRequest& request, const std::filesystem::path& corpus,
                            Store& store, CampaignObserver& observer) {
  return catch_store_problem([&] {
    CampaignRun run{request, corpus, store, observer};
    if (request.plugin) note_library(store, *request.plugin);
    note_begin(store);
    if (request.plugin) run.note_isolation();
    observer.on_begin(store.trial_count());
    const Canary canary = meet_canary(request);
    store.set(to_row(canary));
    observer.on_canary(canary);
    observer.on_phase("trials");
    const auto trials = run_trials(request, store, run.after(trials_share),
                                   [&](const TrialProgress& state) { observer.on_trial(state); });
    if (trials.problem) throw StoreProblem(*trials.problem);
    store.set(to_row(HarnessProblem{trials.harness_problem, store.trial_count()}));
    observer.on_trials(trials);
    const bool complete = trials.complete;
    if (complete && request.plugin) {
      observer.on_phase("repetitions");
      repeat_large_meshes(request, store, run.after(1), run.progress_);
    }
    if (complete && request.plan.search > 0) {
      observer.on_phase("search");
      search_share(request, corpus, store, run.after(faults_share), run.progress_);
    }
    observer.on_phase("shrinking");
    run.shrink(complete);
    observer.on_failures_shrunk(value_or_throw(store.kept_failures()));
    if (request.power) run.take_power();
    if (complete && !request.power && request.plan.fault_cases > 0) {
      observer.on_phase("faults");
      run.hunt();
    }
    if (complete && request.plan.tetrahedron_seconds > 0) {
      observer.on_phase("tetrahedron");
      run.explore_worlds();
    }
    if (request.library) value_or_throw(request.library->is_as_it_was());
  });
}

double shrinking_seconds(const CampaignPlan& plan) {
  constexpr double without_limit = 120;
  return plan.seconds == 0 ? without_limit : plan.shrink_share * plan.seconds;
}

namespace {

// Stores, for each signature that is not in the store, the failure with the smallest mesh, by the
// length of its text.
void add_smallest(const std::vector<FailureRecord>& failures, Store& store) {
  std::set<std::string> signatures;
  for (const auto& record : store.failures()) signatures.insert(record.signature());
  std::map<std::string, const FailureRecord*> smallest;
  for (const auto& failure : failures) {
    if (signatures.contains(failure.signature())) continue;
    const auto*& best = smallest[failure.signature()];
    if (!best || failure.mesh.size() < best->mesh.size()) best = &failure;
  }
  for (const auto& [signature, failure] : smallest) store.add(*failure);
}

}  // namespace

Expected<FailureList> shrink_corpus_failures(const CampaignRequest& request,
                                             const std::vector<FailureRecord>& failures,
                                             Store& store, const OnText& progress) {
  return catch_store_problem([&] {
    add_smallest(failures, store);
    shrink_failures(request, store, shrinking_of_one,
                    deadline_in(std::chrono::steady_clock::now(), shrinking_seconds(request.plan)),
                    progress);
    auto list = value_or_throw(store.kept_failures());
    std::erase_if(list.list, [](const auto& failure) { return !failure.is_of_corpus(); });
    return list;
  });
}

Expected<void> keep_corpus(Store& store, const std::vector<JudgedSource>& rows,
                           const std::vector<FailureRecord>& failures, KeepMeshes when) {
  return catch_store_problem([&] {
    for (const auto& row : rows) store.set(to_row(row));
    std::set<std::string> signatures;
    for (const auto& failure : failures) signatures.insert(failure.signature());
    store.keep_corpus_failures(signatures);
    if (when == KeepMeshes::now) add_smallest(failures, store);
  });
}

namespace {

// Chooses `count` of the numbers below `all`, each equally likely. This is Floyd's algorithm,
// which needs only as many random numbers as it chooses.
std::set<std::uint64_t> choose(std::uint64_t count, std::uint64_t all, std::uint64_t seed) {
  Random random(seed, 0);
  std::set<std::uint64_t> numbers;
  for (std::uint64_t i = all - count; i < all; ++i) {
    const std::uint64_t number = random.next() % (i + 1);
    if (!numbers.insert(number).second) numbers.insert(i);
  }
  return numbers;
}

// Names the first thing in which the two trials differ. Empty if they do not differ.
std::string difference_of_trials(const TrialRecord& first, const TrialRecord& now,
                                 const DetectorUnderTest& detector) {
  for (std::size_t c = 0; c < detector.configurations.size(); ++c) {
    const auto letter = [&](const TrialRecord& record) {
      return c < record.outcomes.size() ? std::string(1, record.outcomes[c]) : "nothing";
    };
    if (letter(first) != letter(now))
      return fmt::format("{} has outcome {} now, but {} is stored", detector.configurations[c].name,
                         letter(now), letter(first));
  }
  for (const auto& [name, member] : {std::pair("triangles", &TrialRecord::triangles),
                                     {"steps", &TrialRecord::steps},
                                     {"collisions", &TrialRecord::collisions},
                                     {"pairs", &TrialRecord::pairs}}) {
    if (first.*member != now.*member)
      return fmt::format("{} {} now, but {} stored", now.*member, name, first.*member);
  }
  if (first.mesh != now.mesh) return "its mesh differs from the stored mesh";
  if (first.outcomes != now.outcomes) return "it has more outcomes than configurations";
  if (first.counts != now.counts) return "its counts differ from the stored counts";
  return "";
}

// Runs the trials of one store once more. Names the first trial with another result; empty if there
// is none.
std::string difference_of_store(const CampaignRequest& request,
                                const std::vector<TrialRecord>& records, const OnTrial& progress) {
  std::set<std::string> ids;
  for (const auto& record : records) ids.insert(record.id);
  const ScratchFolder scratch = value_or_throw(ScratchFolder::make());
  Store store = value_or_throw(Store::open(scratch.path() / "again", binding_of(request)));
  const auto end = run_trials(request, store, RunDeadline::max(), progress, &ids);
  if (end.problem) throw StoreProblem(*end.problem);
  if (!end.harness_problem.empty()) throw StoreProblem(end.harness_problem);
  std::map<std::string, TrialRecord> now;
  store.for_each_trial([&](const TrialRecord& record) { now[record.id] = record; });
  for (const auto& record : records) {
    const auto place = now.find(record.id);
    const auto difference = place == now.end()
                                ? std::string("the campaign has no such trial")
                                : difference_of_trials(record, place->second,
                                                       request.detector.in_stratum(record.family));
    if (!difference.empty()) return fmt::format("trial {}: {}", record.id, difference);
  }
  return "";
}

}  // namespace

Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed, const OnTrial& progress) {
  return catch_store_problem([&] {
    const auto files = value_or_throw(stored_runs(folder));
    TrialsAgain again;
    for (const auto& file : files) again.all += value_or_throw(Store::read(file)).trial_count();
    if (again.all == 0)
      throw StoreProblem(fmt::format("{}: no trial is stored here", folder.string()));
    const auto count = std::ceil(share * static_cast<double>(again.all));
    again.trials = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(count), 1, again.all);
    const auto numbers = choose(again.trials, again.all, seed);
    std::uint64_t number = 0;  // counts the trials of all stores
    for (const auto& file : files) {
      const Store store = value_or_throw(Store::read(file));
      std::vector<TrialRecord> records;  // in the order of their families and places
      store.for_each_trial([&](const TrialRecord& record) {
        if (numbers.contains(number++)) records.push_back(record);
      });
      if (records.empty()) continue;
      const auto run = value_or_throw(read_binding(store.binding(), file));
      request.seed = run.seed;
      request.shares = run.shares;
      const auto difference = difference_of_store(request, records, progress);
      if (difference.empty()) continue;
      again.difference = difference;
      break;
    }
    return again;
  });
}

}  // namespace assay::properties
