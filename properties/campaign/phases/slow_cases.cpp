#include "properties/campaign/phases/slow_cases.h"

#include <algorithm>
#include <stdexcept>

#include "properties/campaign/trials/planned_case.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {
namespace {

// A trial is near its limit if it took at least this share of it.
constexpr double near_share = 1. / 3;

struct SlowTrial {
  std::string id, family;
  std::size_t configuration = 0;  // the first configuration that is undecided, or 0
  bool is_undecided = false;
  bool is_asleep = false;  // it slept: processor time cannot show that a smaller case is as slow
  double seconds = 0;
};

// Undecided trials come first, then the slower ones. Equal ones are ordered by their ids.
bool is_before(const SlowTrial& a, const SlowTrial& b) {
  if (a.is_undecided != b.is_undecided) return a.is_undecided;
  if (a.seconds != b.seconds && !a.is_undecided) return a.seconds > b.seconds;
  return a.id < b.id;
}

std::vector<SlowTrial> slowest_trials(const Store& store, double limit) {
  std::vector<SlowTrial> list;
  store.for_each_trial([&](const TrialRecord& r) {
    const auto undecided = r.outcomes.find(letter_of(Outcome::undecided));
    const double seconds = 1e-6 * static_cast<double>(r.slowest_us);
    const bool is_undecided = undecided != std::string::npos;
    if (!is_undecided && seconds < near_share * limit) return;
    list.push_back({r.id, r.family, is_undecided ? undecided : 0, is_undecided,
                    seconds < 0.5 * limit, seconds});
  });
  std::sort(list.begin(), list.end(), is_before);
  if (list.size() > slow_cases_kept) list.resize(slow_cases_kept);
  return list;
}

class SlowCases {
 public:
  SlowCases(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
            RunDeadline deadline)
      : request_(request), store_(store), limits_(limits), deadline_(deadline) {
    WorkerLimits patient = request.worker_limits();
    patient.seconds *= 2;
    worker_.emplace(request.worker, request.plugin, patient);
  }

  void keep(const SlowTrial& trial, const std::function<void(const std::string&)>& progress) {
    const auto known = families();
    const auto family = std::find_if(known.begin(), known.end(),
                                     [&](const Family& f) { return f.name == trial.family; });
    if (family == known.end()) return;
    const auto planned = case_within(request_.detector.contract, *family, trial.id);
    if (!planned.seen) return;
    const auto& configuration = request_.detector.configurations[trial.configuration];
    SlowCase slow;
    slow.id = trial.id;
    slow.configuration = configuration.name;
    slow.shard = text_of(request_.shard);
    slow.undecided = trial.is_undecided;
    slow.seconds = trial.seconds;
    slow.limit = request_.plan.case_seconds;
    slow.mesh = corpus::case_text(*planned.seen);
    store_.set(to_row(slow));
    if (!trial.is_undecided || trial.is_asleep || seconds_left() <= 0) return;
    if (progress) progress(trial.id);
    const ReduceLimits bounded{std::min(limits_.seconds, seconds_left()), limits_.calls};
    const auto judge = judge_of_slowness(request_.detector, configuration, *worker_,
                                         2 * request_.plan.case_seconds);
    const auto reduction = reduce(*planned.seen, judge, bounded, [&](const corpus::Case& better) {
      slow.smallest = corpus::case_text(better);
      store_.set(to_row(slow));
    });
    if (slow.smallest.empty() && !reduction.finding.signature.empty()) {
      slow.smallest = slow.mesh;  // nothing smaller was found to be as slow
      store_.set(to_row(slow));
    }
  }

 private:
  double seconds_left() const {
    return std::chrono::duration<double>(deadline_ - std::chrono::steady_clock::now()).count();
  }

  const CampaignRequest& request_;
  Store& store_;
  const ReduceLimits& limits_;
  const RunDeadline deadline_;
  std::optional<WorkerProcess> worker_;
};

}  // namespace

Judge judge_of_slowness(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, double seconds) {
  return [&detector, configuration, &worker,
          seconds](const corpus::Case& c) -> std::optional<Finding> {
    const auto seen = contracted(c, detector.contract);
    if (!seen) return std::nullopt;
    int slow = 0, quick = 0;
    while (slow < 2 && quick < 2) {
      const auto run = worker.run(*seen, {&configuration, 1}).front();
      if (run.end == RunEnd::not_run) throw std::runtime_error(run.explanation);
      const bool is_slow = run.end == RunEnd::hung && run.processor_seconds >= seconds;
      ++(is_slow ? slow : quick);
    }
    if (slow < 2) return std::nullopt;
    return Finding{"slow", {}, 0};
  };
}

void keep_slow_cases(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline,
                     const std::function<void(const std::string&)>& progress) {
  EvidenceFacts stored;
  for (const auto& row : store.evidence()) stored.take(row);
  const auto is_stored = [&](const SlowTrial& trial) {
    return std::any_of(stored.slow.begin(), stored.slow.end(),
                       [&](const SlowCase& slow) { return slow.id == trial.id; });
  };
  SlowCases slow_cases(request, store, limits, deadline);
  for (const auto& trial : slowest_trials(store, request.plan.case_seconds)) {
    if (!is_stored(trial)) slow_cases.keep(trial, progress);
  }
}

}  // namespace assay::properties
