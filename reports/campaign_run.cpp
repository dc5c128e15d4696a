#include "reports/campaign_run.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/binding.h"
#include "properties/campaign/shrink.h"
#include "properties/worker/worker_process.h"
#include "reports/certificate/evidence.h"
#include "reports/detector_choice.h"
#include "reports/exit_code.h"
#include "reports/failure_text.h"
#include "reports/interruption.h"
#include "reports/page_data/run_evidence.h"
#include "reports/plain_progress.h"
#include "reports/plugin_text.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;

class CampaignRun {
 public:
  CampaignRun(const properties::CampaignRequest& request, properties::Store& store, std::string out,
              CampaignResults& results)
      : request_(request),
        store_(store),
        out_(std::move(out)),
        results_(results),
        shard_(properties::text_of(request.shard)),
        begin_(Clock::now()) {}

  std::optional<std::string> run() {
    announce();
    note_library(store_, request_);
    meet_canary();
    run_trials();
    if (!results_.trials.store_problem.empty()) return results_.trials.store_problem;
    shrink();
    hunt_faults();
    explore_world();
    results_.tally = sum();
    print_tables();
    const auto failures =
        write_failures(store_, out_, request_.plugin ? request_.plugin->string() : "");
    fmt::print("{}", failures.text);
    results_.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    return failures.problem;
  }

 private:
  properties::RunDeadline after(double share) const {
    return begin_ + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(share * request_.plan.seconds));
  }

  void announce() const {
    const auto& plan = request_.plan;
    const auto end = std::time(nullptr) + static_cast<std::time_t>(plan.seconds);
    const auto planned = properties::planned_trial_count(plan, request_.shard);
    const auto stored = store_.trial_count();
    fmt::print("campaign {}, seed {}, shard {}/{}: {} trials of {} families{}, {} configurations",
               plan.name, request_.seed, request_.shard.index, request_.shard.count, planned,
               plan.strata.size(),
               stored ? fmt::format(" ({} are stored, {} to do)", stored, planned - stored) : "",
               request_.detector.configurations.size());
    if (plan.fault_cases > 0) fmt::print("; {} planted faults", properties::planted_count());
    fmt::print("; {} jobs; until {:%H:%M:%S} at the latest\n", request_.jobs,
               *std::localtime(&end));
    fmt::print("{}\nwrites {}\n",
               request_.detector.built_in
                   ? "detector built-in"
                   : plugin_text(request_.detector.name, request_.detector.claims,
                                 request_.detector.contract),
               out_);
    std::fflush(stdout);
  }

  // A detector that is known to be wrong goes the whole way that the one under test goes.
  void meet_canary() {
    results_.canary = properties::meet_canary(request_);
    fmt::print("canary {}: {}\n", results_.canary.fault,
               results_.canary.found_after
                   ? fmt::format("found after {} cases", *results_.canary.found_after)
                   : "NOT FOUND: the harness sees nothing");
    std::fflush(stdout);
    store_canary(store_, shard_, results_.canary);
  }

  void run_trials() {
    PlainProgress progress("trials");
    const bool others = request_.plan.fault_cases > 0 || request_.plan.tetrahedron_seconds > 0;
    results_.trials = properties::run_trials(
        request_, store_, after(others ? trials_share : 1),
        [&](const properties::TrialProgress& state) {
          progress.show(fmt::format("{}/{} trials, {} with a defect", state.done, state.planned,
                                    state.defects));
        });
    progress.finish();
    store_harness_problem(store_, shard_, results_.trials.harness_problem);
    if (!results_.trials.harness_problem.empty())
      fmt::print("harness: {}\n", results_.trials.harness_problem);
    if (results_.trials.trials > 0) {
      fmt::print("{} trials in {:.1f} s\n", results_.trials.trials, results_.trials.seconds);
    }
  }

  void hunt_faults() {
    if (request_.plan.fault_cases == 0) return;
    PlainProgress progress("faults");
    const auto show = [&](const std::string& text) { progress.show(text); };
    std::vector<properties::Fault> mine;
    std::uint64_t place = 0;
    for (const auto& fault : properties::faults()) {
      if (request_.shard.holds(place++)) mine.push_back(fault);
    }
    const properties::FaultHunt hunt{
        request_.plan.name,        request_.seed, request_.plan.fault_seeds,
        request_.plan.fault_cases, request_.jobs, ASSAY_CORPUS_DIR};
    results_.faults = properties::hunt_faults(hunt, mine, after(faults_share), show);
    // Those of the registry outlive `mine`.
    for (auto& result : results_.faults) result.fault = properties::find_fault(result.fault->name);
    results_.time_for_faults = Clock::now() < after(faults_share);
    if (request_.plan.shrink_faults) {
      constexpr double seconds_each = 60;
      properties::shrink_faults(results_.faults, {seconds_each, 1'000'000}, request_.jobs, after(1),
                                show);
    }
    store_faults(store_, shard_, hunt, results_.faults, results_.time_for_faults);
  }

  void explore_world() {
    if (request_.plan.tetrahedron_seconds <= 0) return;
    PlainProgress progress("tetrahedron");
    progress.show("every motion of a tetrahedron on a small grid");
    const auto end = std::min(
        after(1),
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(request_.plan.tetrahedron_seconds)));
    std::uint64_t place = 0;
    for (const auto& world : properties::tetrahedron_worlds()) {
      if (!request_.shard.holds(place++)) continue;
      const double left = std::chrono::duration<double>(end - Clock::now()).count();
      if (left <= 0) break;
      results_.worlds.emplace_back(&world, properties::prove(world, {request_.jobs, left, {}}));
      store_world(store_, shard_, world, results_.worlds.back().second);
    }
  }

  void shrink() {
    PlainProgress progress("shrinking");
    const double share = request_.plan.shrink_share * request_.plan.seconds;
    const auto end = std::min(after(1), Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                           std::chrono::duration<double>(share)));
    constexpr double seconds_each = 60;
    properties::shrink_failures(request_, store_, {seconds_each, 1'000'000}, end,
                                [&](const std::string& text) { progress.show(text); });
  }

  properties::Tally sum() const {
    properties::Tally tally;
    store_.for_each_trial([&](const properties::TrialRecord& record) { tally.add(record); });
    return tally;
  }

  void print_tables() const {
    const auto& tally = results_.tally;
    if (!request_.plan.strata.empty()) {
      fmt::print("\n{}\n{}\n{}", strata_text(tally, request_), distribution_text(tally),
                 tags_text(tally.counts));
      if (!request_.detector.built_in) {
        const auto left_out = tally.counts.find(properties::left_out_misses_name);
        fmt::print("the contract leaves out what would have been a miss in {} steps\n",
                   left_out == tally.counts.end() ? 0 : left_out->second);
      }
      if (request_.detector.built_in && request_.plan.laws_every > 0) {
        fmt::print("\n{}", laws_text(tally.counts, request_.plan.law_premises));
      }
    }
    if (!results_.faults.empty()) fmt::print("\n{}", faults_text(results_.faults));
    const auto shrinking = shrinking_text(results_.faults);
    if (!shrinking.empty()) fmt::print("\n{}", shrinking);
    if (!results_.worlds.empty()) fmt::print("\n{}", worlds_text(results_.worlds));
  }

  // Shares of the plan's time that are over when a phase must be. Shrinking, after the trials, has
  // its own share.
  static constexpr double trials_share = 0.5, faults_share = 0.9;

  const properties::CampaignRequest& request_;
  properties::Store& store_;
  const std::string out_;
  CampaignResults& results_;
  const std::string shard_;
  const Clock::time_point begin_;
};

}  // namespace

std::optional<std::string> ask_for_campaign(const CampaignWords& words,
                                            properties::CampaignRequest& request) {
  end_when_interrupted(fmt::format("interrupted: what was judged is stored in {}; run the same "
                                   "again to go on",
                                   words.out),
                       exit_undecided);
  auto plan = properties::find_plan(words.campaign);
  if (!plan) return plan.error().message;
  request.plan = std::move(plan.value());
  request.seed = words.seed;
  request.jobs = words.jobs;
  request.worker = properties::worker_program();
  if (auto problem = choose_detector(words.detector, request)) return problem;
  std::error_code error;
  std::filesystem::create_directories(words.out, error);
  if (error) return fmt::format("{}: cannot be made: {}", words.out, error.message());
  return std::nullopt;
}

std::optional<std::string> run_phases(const properties::CampaignRequest& request,
                                      properties::Store& store, const std::string& out,
                                      CampaignResults& results) {
  return CampaignRun(request, store, out, results).run();
}

}  // namespace assay::reports
