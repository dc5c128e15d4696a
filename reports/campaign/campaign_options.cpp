#include "reports/campaign/campaign_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "properties/campaign/phases/fault_hunt.h"
#include "properties/campaign/plan.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/cases.h"
#include "reports/campaign/own_cases.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/text_file.h"

namespace assay::reports {

namespace {

// Reads the public sequences. Refuses a folder in which none of them is there, or in which one
// cannot be used.
Expected<std::vector<corpus::Case>> public_sequences(const std::string& folder) try {
  std::vector<std::string> missing;
  std::vector<corpus::Case> cases;
  for (auto& real : real_sequences(BenchSettings{folder}, missing)) {
    corpus::Case c;
    c.id = real.name;
    c.triangles = std::move(real.frames.triangles);
    c.frames = std::move(real.frames.frames);
    cases.push_back(std::move(c));
  }
  if (cases.empty())
    return Problem{fmt::format("{}: none of the public sequences is there", folder)};
  return cases;
} catch (const UnusableData& problem) {
  return Problem{problem.what()};
}

}  // namespace

void add_campaign_options(Verb& verb, CampaignWords& words) {
  add_seed(verb, words.seed, "Of all random cases; a fresh one a night");
  verb.add("--time SECONDS", words.time_limit,
           "Seconds by the clock for the campaign, in place of its own limit; what is left "
           "over then is incomplete")
      .with(positive())
      .in(OptionGroup::limits);
  verb.add("--case-seconds SECONDS", words.case_seconds,
           "Processor time of one case, in place of the campaign's own (10); then it is undecided")
      .with(positive())
      .in(OptionGroup::limits);
  add_choice(verb, "--memory SIZE", words.memory, "a whole number above 0, alone or with K, M or G",
             memory_size,
             "Address space of the process that runs a case, such as 6GB or 512MB, in place of the "
             "campaign's own (4GB); then memory fails there")
      .in(OptionGroup::limits);
  verb.add("--power DIR", words.power,
           "Folder of a run or certificate of this build: planted faults are proved by it, "
           "not again");
  verb.add("--corpus DIR", words.own_cases,
           "Folder of case files of your own (assay-case/1), judged beside what is shipped");
  verb.add("--data DIR", words.data,
           "Folder of the public data: a plug-in that claims to be deterministic is run again and "
           "again on its sequences too");
  add_detector(verb, words.detector);
  add_part(verb, words.detector.part);
  add_jobs(verb, words.jobs);
}

Expected<properties::CampaignRequest> ask_for_campaign(const CampaignWords& words) {
  end_when_interrupted(fmt::format("interrupted: what was judged is stored in {}; run the same "
                                   "again to go on",
                                   words.out),
                       exit_undecided);
  BOOST_OUTCOME_TRY(plan, properties::find_plan(words.campaign));
  properties::CampaignRequest request;
  request.plan = std::move(plan);
  if (words.time_limit) request.plan.seconds = *words.time_limit;
  if (words.case_seconds) request.plan.case_seconds = *words.case_seconds;
  if (words.memory) request.plan.case_bytes = *words.memory;
  request.seed = words.seed;
  request.jobs = words.jobs;
  request.shares = words.shares;
  if (!words.own_cases.empty()) {
    BOOST_OUTCOME_TRY(own, read_own_cases(words.own_cases));
    if (own.cases.empty()) {
      fmt::print("{}: there is no case in it yet\n", words.own_cases);
    } else {
      request.own_cases = std::move(own);
    }
  }
  request.worker = properties::worker_program();  // of which a proof speaks, too
  // The proof is read before the first code of a plug-in runs.
  if (!words.power.empty() && request.plan.fault_cases == 0) {
    fmt::print("campaign {} plants no faults: --power is not needed\n", request.plan.name);
  } else if (!words.power.empty()) {
    BOOST_OUTCOME_TRY(proof, properties::take_power(words.power, words.out, request));
    request.power = std::move(proof);
  }
  auto chosen_words = words.detector;
  if (asks_queries_alone(request.plan) && chosen_words.part == DetectorPart::by_library)
    chosen_words.part = DetectorPart::query;
  BOOST_OUTCOME_TRY(subject, choose_detector(chosen_words));
  static_cast<properties::Subject&>(request) = std::move(subject);
  const auto& detector = request.detector;
  if (!words.data.empty()) {
    BOOST_OUTCOME_TRY(sequences, public_sequences(words.data));
    request.repeated = std::move(sequences);
  }
  if (!detector.built_in &&
      judged_claims(detector.claims, detector.contract, detector.of_queries).empty())
    return Problem{fmt::format(
        "{}: it claims nothing that its contract leaves to be judged; there is nothing to certify",
        words.detector.library)};
  const auto& named = properties::named_plans();
  const bool is_named = std::any_of(named.begin(), named.end(),
                                    [&](const auto& one) { return one.name == request.plan.name; });
  if (is_named && !detector.contract.takes_relations)
    request.plan = properties::without_relations(std::move(request.plan));
  if (!detector.built_in) request.plan = properties::without_questions(std::move(request.plan));
  const bool with_query = detector.query_claims != properties::Claims();
  if (words.detector.part == DetectorPart::steps)
    request.plan = properties::without_queries(std::move(request.plan));
  if (detector.of_queries) {
    request.plan = properties::query_plan(std::move(request.plan));
  } else if (with_query) {
    request.plan = properties::with_queries(std::move(request.plan));
  } else if (asks_queries(request.plan)) {
    return Problem{fmt::format("campaign {}: its strata are queries, of a plug-in's query alone",
                               request.plan.name)};
  }
  return request;
}

Expected<void> may_keep_run(const std::filesystem::path& out,
                            const std::vector<std::string>& files) {
  BOOST_OUTCOME_TRY(may_fill(out, files));
  for (const auto* part : {"failures", "slow"}) {
    std::error_code ignored;
    if (std::filesystem::exists(out / part, ignored)) {
      BOOST_OUTCOME_TRY(may_fill(out / part));
    }
  }
  return outcome::success();
}

}  // namespace assay::reports
