#include "properties/campaign/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "properties/campaign/case_tally.h"
#include "properties/campaign/clean_starts.h"
#include "properties/case_check.h"
#include "properties/generators/families.h"
#include "properties/random.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index) {
  return fmt::format("{}:{}:{}:{}", plan.name, seed, family, index);
}

corpus::Case failing_case(const corpus::Case& c, const Configuration& configuration,
                          const DetectorUnderTest& detector, const Failure& failure) {
  corpus::Case out = c;
  out.about = fmt::format("{}; {}", failure.signature(), failure.what);
  out.source =
      fmt::format("campaign case {}, detector {}, {}", c.id, detector.name, configuration.name);
  std::replace(out.id.begin(), out.id.end(), ':', '-');
  if (detector.built_in) out.options = options_text(configuration.options);
  return out;
}

namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t microseconds_since(Clock::time_point begin) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin).count());
}

// Of triangles and frames, bit by bit: two cases of one hash count as one.
std::uint64_t mesh_hash(const corpus::Case& c) {
  const auto bytes = [](const auto& matrix) {
    return std::string_view(reinterpret_cast<const char*>(matrix.data()),
                            sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
  };
  std::uint64_t hash = Random::hash(bytes(c.triangles));
  // Each link of the chain is a bijection of what came before, mixed by a multiplication.
  for (const auto& frame : c.frames) {
    hash = (hash ^ Random::hash(bytes(frame))) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

struct PlannedTrial {
  const Family* family;
  std::uint64_t index;
};

// Families in turn, so that a run that ends early has judged all of them.
std::vector<PlannedTrial> planned_trials(const CampaignPlan& plan, const Shard& shard) {
  std::vector<PlannedTrial> list;
  std::uint64_t most = 0;
  for (const auto& stratum : plan.strata) most = std::max(most, stratum.cases);
  for (std::uint64_t i = 0; i < most; ++i) {
    for (const auto& stratum : plan.strata) {
      if (i >= stratum.cases || !shard.holds(i)) continue;
      const auto known = families();
      const auto family = std::find_if(known.begin(), known.end(),
                                       [&](const Family& f) { return f.name == stratum.family; });
      list.push_back({&*family, i});
    }
  }
  return list;
}

class Trials {
 public:
  Trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
         const std::function<void(const TrialProgress&)>& progress)
      : request_(request),
        store_(store),
        deadline_(deadline),
        progress_(progress),
        planned_(planned_trials(request.plan, request.shard)),
        met_(store.signatures()) {}

  TrialsEnd run() {
    const auto begin = Clock::now();
    std::vector<std::thread> threads;
    for (int j = 0; j < request_.jobs; ++j) threads.emplace_back([this] { work(); });
    for (auto& thread : threads) thread.join();
    end_.complete = state_.done == planned_.size();
    end_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return end_;
  }

 private:
  // Every 16th trial is run twice, for the claim `deterministic`.
  static constexpr std::uint64_t repeat_every = 16;
  static constexpr std::uint64_t meshes_kept = 3;  // of a signature

  void work() {
    WorkerProcess worker(request_.worker, request_.plugin, {request_.plan.case_seconds, 0});
    while (const PlannedTrial* trial = next_trial()) {
      try {
        judge(*trial, worker);
      } catch (const StoreProblem& problem) {
        const std::lock_guard lock(mutex_);
        end_.store_problem = problem.what();
      } catch (const std::exception& failure) {
        const std::lock_guard lock(mutex_);
        end_.harness_problem = failure.what();
      }
    }
  }

  const PlannedTrial* next_trial() {
    const std::lock_guard lock(mutex_);
    while (next_ < planned_.size() && end_.harness_problem.empty() && end_.store_problem.empty() &&
           Clock::now() < deadline_) {
      const PlannedTrial& trial = planned_[next_++];
      if (!store_.has_trial(id_of(trial))) return &trial;
      ++state_.done;
    }
    return nullptr;
  }

  std::string id_of(const PlannedTrial& trial) const {
    return trial_id(request_.plan, request_.seed, std::string(trial.family->name), trial.index);
  }

  void judge(const PlannedTrial& planned, WorkerProcess& worker) {
    const GeneratedCase made = make_case(*planned.family, id_of(planned));
    const bool vouched = is_vouched_for(request_.detector, made.c, planned.index);
    const auto configurations = vouched ? with_clean_start(request_.detector.configurations)
                                        : request_.detector.configurations;
    TrialRecord record;
    if (request_.detector.built_in)
      ++record.counts[vouched ? "tag:start:clean" : "tag:start:verified"];
    record.id = made.c.id;
    record.family = planned.family->name;
    record.index = planned.index;
    record.mesh = mesh_hash(made.c);
    auto begin = Clock::now();
    const auto seen = contracted(made.c, request_.detector.contract);
    if (!seen) return keep(record, {});  // no case for this detector: its numbers do not hold it
    const auto truth = judge_case(*seen);
    record.oracle_us = microseconds_since(begin);
    begin = Clock::now();
    const std::vector<CaseRun> runs = worker.run(made.c, configurations);
    record.detector_us = microseconds_since(begin);
    record.triangles = static_cast<std::uint64_t>(made.c.triangles.rows());
    for (const auto& step : truth) {
      ++record.steps;
      record.collisions += step.pairs.empty() ? 0 : 1;
      record.pairs += step.pairs.size();
    }
    std::vector<CaseRun> again;
    if (planned.index % repeat_every == 0) again = worker.run(made.c, configurations);
    std::vector<StoredFailure> failures;
    for (std::size_t i = 0; i < configurations.size(); ++i) {
      if (runs[i].end == RunEnd::not_run) throw std::runtime_error(runs[i].what);
      Verdict verdict = judge_trial(*seen, truth, runs[i], configurations[i], request_.detector,
                                    again.empty() ? nullptr : &again[i]);
      bool flaky = false;
      if (verdict.outcome == Outcome::defect) {
        // A failure is run twice before it is reported; a difference is itself a failure.
        const auto repeated = worker.run(made.c, {&configurations[i], 1});
        flaky = !same_answers(runs[i], repeated[0]);
      }
      record.outcomes += letter_of(verdict.outcome);
      if (verdict.left_out_misses > 0)
        record.counts[left_out_misses_name] += verdict.left_out_misses;
      if (!verdict.failure) continue;
      const auto failing =
          failing_case(made.c, configurations[i], request_.detector, *verdict.failure);
      failures.push_back({made.c.id, configurations[i].name,
                          verdict.failure->signature() + (flaky ? " (flaky)" : ""),
                          verdict.failure->what, corpus::case_text(failing), "", flaky});
    }
    if (request_.detector.built_in) {
      const bool with_laws =
          request_.plan.laws_every > 0 && planned.index % request_.plan.laws_every == 0;
      CaseTally tally = tally_case(made, configurations, runs, truth, with_laws);
      add(record.counts, tally.counts);
      for (const auto& broken : tally.broken)
        failures.push_back(broken_law(made.c, broken, configurations));
    }
    keep(record, failures);
  }

  static StoredFailure broken_law(const corpus::Case& c, const BrokenLaw& broken,
                                  std::span<const Configuration> configurations) {
    corpus::Case failing = c;
    failing.about = fmt::format("breaks {}; {}", broken.law, broken.what);
    failing.source = fmt::format("campaign case {}, {}", c.id, broken.configuration);
    for (const auto& configuration : configurations) {
      if (configuration.name == broken.configuration)
        failing.options = options_text(configuration.options);
    }
    // The id stays: laws that choose at random, or look at some of the cases, go by it.
    // The store's key is case and configuration: a case may break a law and a claim.
    return {c.id,
            fmt::format("{}{}{}", broken.configuration, law_in_configuration, broken.law),
            fmt::format("law {}", broken.law),
            broken.what,
            corpus::case_text(failing),
            "",
            false};
  }

  void keep(const TrialRecord& record, const std::vector<StoredFailure>& failures) {
    const std::lock_guard lock(mutex_);
    std::vector<StoredFailure> kept;
    std::vector<MetFailure> met;
    for (const auto& failure : failures) {
      met.push_back({failure.configuration, failure.signature});
      if (met_[failure.signature]++ < meshes_kept) kept.push_back(failure);
    }
    // At once: a run that is killed counts nothing twice when it goes on.
    store_.add(record, kept, met);
    ++end_.trials;
    ++state_.done;
    state_.planned = planned_.size();
    state_.defects += failures.empty() ? 0 : 1;
    if (progress_) progress_(state_);
  }

  const CampaignRequest& request_;
  Store& store_;
  const RunDeadline deadline_;
  const std::function<void(const TrialProgress&)>& progress_;
  const std::vector<PlannedTrial> planned_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  TrialProgress state_;
  TrialsEnd end_;
  Counts met_;
};

}  // namespace

std::uint64_t planned_trial_count(const CampaignPlan& plan, const Shard& shard) {
  std::uint64_t count = 0;
  for (const auto& stratum : plan.strata) {
    count += (stratum.cases + shard.count - shard.index) / shard.count;
  }
  return count;
}

TrialsEnd run_trials(const CampaignRequest& request, Store& store, RunDeadline deadline,
                     const std::function<void(const TrialProgress&)>& progress) {
  return Trials(request, store, deadline, progress).run();
}

}  // namespace assay::properties
