// `assay run`: a campaign in one shard, and its outcome.
#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/binding.h"
#include "reports/campaign_run.h"
#include "reports/certificate/run_report.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/failure_text.h"
#include "reports/shell_word.h"

namespace assay::reports {
namespace {

using properties::FaultStatus;

constexpr const char* go_on = "; what is stored stays: run the same again to go on";

class Conclusion {
 public:
  Conclusion(const RunCommandRequest& command, const properties::CampaignRequest& request,
             const CampaignResults& results)
      : command_(command), request_(request), results_(results) {}

  int conclude() const {
    const auto& tally = results_.tally;
    const auto harness = harness_faults();
    for (const auto& line : harness) fmt::print("HARNESS: {}\n", line);
    std::uint64_t defects = 0, unsettled = 0;
    bool bounds_met = true;
    for (const auto& stratum : request_.plan.strata) {
      const auto found = tally.strata.find(stratum.family);
      // A bound is wanted of all shards together: merge and certify ask for it.
      const bool is_of_all_shards = stratum.wanted_bound > 0 && request_.shard.count > 1;
      if (found == tally.strata.end()) {
        bounds_met &= stratum.wanted_bound == 0 || is_of_all_shards;
        continue;
      }
      for (const auto& outcomes : found->second.by_configuration) {
        const auto open = outcomes.undecided + outcomes.errors;
        defects += outcomes.defects;
        unsettled += open;
        if (is_of_all_shards) continue;
        // Where no bound is wanted, none may be left open.
        bounds_met &= stratum.wanted_bound == 0
                          ? open == 0
                          : bound_of(outcomes, request_) <= stratum.wanted_bound;
      }
    }
    const bool world_holds =
        std::none_of(results_.worlds.begin(), results_.worlds.end(),
                     [](const auto& world) { return world.second.counterexample.has_value(); });
    const std::uint64_t broken_laws = properties::broken_laws(tally.counts);
    const bool is_complete = results_.trials.complete && !lacks_faults();
    const char* outcome = "holds";
    std::string next = fmt::format("assay list failures {}", shell_word(command_.out));
    int code = exit_holds;
    if (!harness.empty()) {
      outcome = "UNSOUND HARNESS";
      code = exit_unsound;
    } else if (defects > 0 || broken_laws > 0 || !world_holds) {
      outcome = "DEFECT";
      code = exit_defect;
    } else if (!is_complete) {
      outcome = "incomplete: the time ended before all was done";
      next = "run the same again to go on, with --time for another limit";
      code = exit_undecided;
    } else if (!bounds_met) {
      outcome = unsettled > 0 ? "undecided: too many trials have no verdict"
                              : "undecided: a bound is above what is wanted";
      code = exit_undecided;
    }
    fmt::print("\n{}: {} trials with a defect, {} undecided, {} laws broken, in {:.0f} s\n",
               outcome, defects, unsettled, broken_laws, results_.seconds);
    if (code != exit_holds) fmt::print("next: {}\n", next);
    // The exit code may be of a defect as well: who waits for all shards reads this.
    fmt::print("shard {}: {}\n", properties::text_of(request_.shard),
               is_complete ? "complete" : "not complete");
    return code;
  }

 private:
  // Whether the time was over before every planted fault was found: no proof against the harness.
  bool lacks_faults() const {
    return !results_.time_for_faults &&
           std::any_of(results_.faults.begin(), results_.faults.end(),
                       [](const properties::FaultResult& result) {
                         return result.fault->status == FaultStatus::planted && !result.found();
                       });
  }

  // What the harness owes of itself, and does not deliver.
  std::vector<std::string> harness_faults() const {
    const auto& tally = results_.tally;
    std::vector<std::string> list;
    if (!results_.canary.found_after) list.push_back("the canary was not found");
    if (!results_.trials.harness_problem.empty()) list.push_back(results_.trials.harness_problem);
    for (const auto& result : results_.faults) {
      const auto& fault = *result.fault;
      if (fault.status == FaultStatus::planted && !result.found() && results_.time_for_faults)
        list.push_back(fmt::format("planted fault {} was not found", fault.name));
      if (fault.status == FaultStatus::equivalent && result.found())
        list.push_back(fmt::format("{}, registered as equivalent, was found", fault.name));
    }
    const bool laws_ran = request_.detector.built_in && !request_.plan.strata.empty() &&
                          request_.plan.laws_every > 0 && results_.trials.complete &&
                          request_.shard.count == 1;
    if (laws_ran) {
      for (auto& line : properties::starved_laws(tally.counts, request_.plan.law_premises))
        list.push_back(std::move(line));
    }
    return list;
  }

  const RunCommandRequest& command_;
  const properties::CampaignRequest& request_;
  const CampaignResults& results_;
};

}  // namespace

int run_campaign(const RunCommandRequest& command) {
  properties::CampaignRequest request;
  if (const auto wrong = ask_for_campaign(
          {command.campaign, command.seed, command.jobs, command.detector, command.out}, request)) {
    return refuse(*wrong);
  }
  if (command.time_limit) request.plan.seconds = *command.time_limit;
  request.shard = command.shard;
  std::string problem;
  auto store = properties::Store::open(store_file(command.out, request.shard),
                                       properties::binding_of(request), problem);
  if (!store) return refuse(problem);
  try {
    CampaignResults results;
    if (const auto wrong = run_phases(request, *store, command.out, results))
      return refuse(*wrong + go_on);
    if (const auto wrong = write_run_report(request, command.out)) return refuse(*wrong);
    return Conclusion(command, request, results).conclude();
  } catch (const properties::StoreProblem& broken) {
    return refuse(std::string(broken.what()) + go_on);
  }
}

}  // namespace assay::reports
