// `assay run`: a campaign. Canary, trials, planted faults, the exhaustive world, shrinking; then
// its tables and its outcome.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/atomic_file.h"
#include "properties/campaign/campaign_facts.h"
#include "properties/campaign/shrink.h"
#include "reports/campaign_text.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/detector_choice.h"
#include "reports/failure_text.h"
#include "reports/interruption.h"
#include "reports/page_data/run_notes.h"
#include "reports/plain_progress.h"
#include "reports/plugin_text.h"
#include "reports/shell_word.h"

namespace assay::reports {
namespace {

using Clock = std::chrono::steady_clock;
using properties::FaultStatus;

constexpr const char* go_on = "; what is stored stays: run the same again to go on";

class CampaignRun {
 public:
  CampaignRun(const RunCommandRequest& command, properties::CampaignRequest request,
              properties::Store store)
      : command_(command),
        request_(std::move(request)),
        store_(std::move(store)),
        begin_(Clock::now()) {}

  int run() {
    announce();
    note_detector(store_, request_);
    note_end(store_, {});
    meet_canary();
    run_trials();
    if (!trials_.store_problem.empty()) return refuse(trials_.store_problem + go_on);
    shrink();
    hunt_faults();
    explore_world();
    const auto tally = sum();
    print_tables(tally);
    const auto failures = write_failures(store_, command_.out, request_);
    fmt::print("{}", failures.text);
    if (failures.problem) return refuse(*failures.problem);
    return conclude(tally);
  }

 private:
  properties::RunDeadline after(double share) const {
    return begin_ + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(share * request_.plan.seconds));
  }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

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
               command_.out);
    std::fflush(stdout);
  }

  // A detector that is known to be wrong goes the whole way that the one under test goes.
  void meet_canary() {
    canary_ = properties::meet_canary(request_);
    fmt::print("canary {}: {}\n", canary_.fault,
               canary_.found_after ? fmt::format("found after {} cases", *canary_.found_after)
                                   : "NOT FOUND: the harness sees nothing");
    note_canary(store_, canary_);
    std::fflush(stdout);
  }

  void run_trials() {
    PlainProgress progress("trials");
    const bool others = request_.plan.fault_cases > 0 || request_.plan.tetrahedron_seconds > 0;
    trials_ = properties::run_trials(
        request_, store_, after(others ? trials_share : 1),
        [&](const properties::TrialProgress& state) {
          progress.show(fmt::format("{}/{} trials, {} with a defect", state.done, state.planned,
                                    state.defects));
        });
    progress.finish();
    if (!trials_.harness_problem.empty()) fmt::print("harness: {}\n", trials_.harness_problem);
    if (trials_.trials > 0) {
      fmt::print("{} trials in {:.1f} s\n", trials_.trials, trials_.seconds);
    }
  }

  void hunt_faults() {
    if (request_.plan.fault_cases == 0) return;
    PlainProgress progress("faults");
    const auto show = [&](const std::string& text) { progress.show(text); };
    const properties::FaultHunt hunt{
        request_.plan.name,        request_.seed, request_.plan.fault_seeds,
        request_.plan.fault_cases, request_.jobs, ASSAY_CORPUS_DIR};
    faults_ = properties::hunt_faults(hunt, properties::faults(), after(faults_share), show);
    time_for_faults_ = Clock::now() < after(faults_share);
    if (request_.plan.shrink_faults) {
      constexpr double seconds_each = 60;
      properties::shrink_faults(faults_, {seconds_each, 1'000'000}, request_.jobs, after(1), show);
    }
    note_faults(store_, faults_);
  }

  void explore_world() {
    if (request_.plan.tetrahedron_seconds <= 0) return;
    PlainProgress progress("tetrahedron");
    progress.show("every motion of a tetrahedron on a small grid");
    const auto end = std::min(
        after(1),
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(request_.plan.tetrahedron_seconds)));
    for (const auto& world : properties::tetrahedron_worlds()) {
      const double left = std::chrono::duration<double>(end - Clock::now()).count();
      if (left <= 0) break;
      worlds_.emplace_back(&world, properties::prove(world, {request_.jobs, left, {}}));
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

  void print_tables(const properties::Tally& tally) const {
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
    if (!faults_.empty()) fmt::print("\n{}", faults_text(faults_));
    const auto shrinking = shrinking_text(faults_);
    if (!shrinking.empty()) fmt::print("\n{}", shrinking);
    if (!worlds_.empty()) fmt::print("\n{}", worlds_text(worlds_));
  }

  int conclude(const properties::Tally& tally) {
    const auto harness = harness_faults(tally);
    for (const auto& line : harness) fmt::print("HARNESS: {}\n", line);
    std::uint64_t defects = 0, unsettled = 0;
    bool bounds_met = true;
    for (const auto& stratum : request_.plan.strata) {
      const auto found = tally.strata.find(stratum.family);
      if (found == tally.strata.end()) {
        bounds_met &= stratum.wanted_bound == 0;
        continue;
      }
      for (const auto& outcomes : found->second.by_configuration) {
        const auto open = outcomes.undecided + outcomes.errors;
        defects += outcomes.defects;
        unsettled += open;
        // Where no bound is wanted, none may be left open.
        bounds_met &= stratum.wanted_bound == 0
                          ? open == 0
                          : bound_of(outcomes, request_) <= stratum.wanted_bound;
      }
    }
    const bool world_holds = std::none_of(worlds_.begin(), worlds_.end(), [](const auto& world) {
      return world.second.counterexample.has_value();
    });
    const std::uint64_t broken_laws = properties::broken_laws(tally.counts);
    const char* outcome = "holds";
    std::string next = fmt::format("assay list failures {}", shell_word(command_.out));
    int code = exit_holds;
    if (!harness.empty()) {
      outcome = "UNSOUND HARNESS";
      code = exit_unsound;
    } else if (defects > 0 || broken_laws > 0 || !world_holds) {
      outcome = "DEFECT";
      code = exit_defect;
    } else if (!trials_.complete || lacks_faults()) {
      outcome = "incomplete: the time ended before all was done";
      next = "run the same again to go on, with --time for another limit";
      code = exit_undecided;
    } else if (!bounds_met) {
      outcome = unsettled > 0 ? "undecided: too many trials have no verdict"
                              : "undecided: a bound is above what is wanted";
      code = exit_undecided;
    }
    note_end(store_, {outcome, harness, bounds_met});
    fmt::print("\n{}: {} trials with a defect, {} undecided, {} laws broken, in {:.0f} s\n",
               outcome, defects, unsettled, broken_laws, seconds());
    if (code != exit_holds) fmt::print("next: {}\n", next);
    return code;
  }

  // Whether the time was over before every planted fault was found: no proof against the harness.
  bool lacks_faults() const {
    return !time_for_faults_ &&
           std::any_of(faults_.begin(), faults_.end(), [](const properties::FaultResult& result) {
             return result.fault->status == FaultStatus::planted && !result.found();
           });
  }

  // What the harness owes of itself, and does not deliver.
  std::vector<std::string> harness_faults(const properties::Tally& tally) const {
    std::vector<std::string> list;
    if (!canary_.found_after) list.push_back("the canary was not found");
    if (!trials_.harness_problem.empty()) list.push_back(trials_.harness_problem);
    for (const auto& result : faults_) {
      const auto& fault = *result.fault;
      if (fault.status == FaultStatus::planted && !result.found() && time_for_faults_)
        list.push_back(fmt::format("planted fault {} was not found", fault.name));
      if (fault.status == FaultStatus::equivalent && result.found())
        list.push_back(fmt::format("{}, registered as equivalent, was found", fault.name));
    }
    const bool laws_ran = request_.detector.built_in && !request_.plan.strata.empty() &&
                          request_.plan.laws_every > 0 && trials_.complete &&
                          request_.shard.count == 1;
    if (laws_ran) {
      for (auto& line : properties::starved_laws(tally.counts, request_.plan.law_premises))
        list.push_back(std::move(line));
    }
    return list;
  }

  // Shares of the plan's time that are over when a phase must be. Shrinking, after the trials, has
  // its own share.
  static constexpr double trials_share = 0.5, faults_share = 0.9;

  const RunCommandRequest& command_;
  properties::CampaignRequest request_;
  properties::Store store_;
  Clock::time_point begin_;
  properties::CanaryResult canary_;
  properties::TrialsEnd trials_;
  std::vector<properties::FaultResult> faults_;
  bool time_for_faults_ = true;
  WorldResults worlds_;
};

}  // namespace

int run_campaign(const RunCommandRequest& command) {
  end_when_interrupted(fmt::format("interrupted: what was judged is stored in {}; run the same "
                                   "again to go on",
                                   command.out),
                       exit_undecided);
  auto plan = properties::find_plan(command.campaign);
  if (!plan) return refuse(plan.error().message);
  properties::CampaignRequest request;
  request.plan = std::move(plan.value());
  if (command.time_limit) request.plan.seconds = *command.time_limit;
  request.seed = command.seed;
  request.jobs = command.jobs;
  request.shard = command.shard;
  request.worker = properties::worker_program();
  if (auto problem = choose_detector(command.detector, request)) return refuse(*problem);
  std::error_code error;
  std::filesystem::create_directories(command.out, error);
  if (error) return refuse(fmt::format("{}: cannot be made: {}", command.out, error.message()));
  std::string problem;
  auto store = properties::Store::open(store_file(command.out, request.shard),
                                       properties::binding_of(request), problem);
  if (!store) return refuse(problem);
  try {
    return CampaignRun(command, std::move(request), std::move(*store)).run();
  } catch (const properties::StoreProblem& broken) {
    return refuse(std::string(broken.what()) + go_on);
  }
}

}  // namespace assay::reports
