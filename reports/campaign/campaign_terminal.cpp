#include "reports/campaign/campaign_terminal.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/plan.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/cases.h"
#include "reports/campaign/campaign_text.h"
#include "reports/terminal/options.h"

namespace assay::reports {

namespace {

// Reads the public sequences. Refuses a folder that holds none of them, or one that cannot be used.
Expected<std::vector<corpus::Case>> public_sequences(const std::string& folder) try {
  std::vector<std::string> missing;
  std::vector<corpus::Case> cases;
  for (auto& real : real_sequences(BenchSettings{folder}, missing))
    cases.push_back(std::move(real.c));
  if (cases.empty())
    return Problem{fmt::format("{}: this folder has none of the public sequences", folder)};
  return cases;
} catch (const UnusableData& problem) {
  return Problem{problem.what()};
}

// Gives "; about 40 s left", for example, at the rate so far. Gives nothing before there is a
// rate.
std::string rest_text(std::uint64_t count, std::uint64_t remainder, double seconds) {
  constexpr double least_seconds = 1;
  if (count == 0 || remainder == 0 || seconds < least_seconds) return "";
  const double rest = seconds * static_cast<double>(remainder) / static_cast<double>(count);
  constexpr double minute = 60;
  return rest < 2 * minute ? fmt::format("; about {:.0f} s left", rest)
                           : fmt::format("; about {:.0f} min left", rest / minute);
}

class CampaignTerminal : public properties::CampaignObserver {
 public:
  CampaignTerminal(const properties::CampaignRequest& request, std::string out)
      : request_(request), out_(std::move(out)) {}

  void on_begin(std::uint64_t before) override {
    const auto& plan = request_.plan;
    const auto trials = properties::planned_trial_count(plan, request_.shares);
    fmt::print("campaign {}, seed {}{}: {} trials of {} families{}, {} configurations", plan.name,
               request_.seed,
               request_.shares > 1 ? fmt::format(", share 1/{}", request_.shares) : "", trials,
               plan.strata.size(),
               before ? fmt::format(" ({} are stored, {} to do)", before, trials - before) : "",
               request_.detector.configurations.size() + request_.detector.of_questions.size());
    if (request_.power) {
      fmt::print("; planted faults were found by campaign {}, seed {}, of this build",
                 request_.power->source.campaign, request_.power->source.seed);
    } else if (plan.fault_cases > 0) {
      fmt::print("; {} planted faults", properties::planted_count());
    }
    fmt::print("; {} jobs; ", request_.jobs);
    constexpr double soon_enough_to_tell = 1e8;
    if (plan.seconds > 0 && plan.seconds < soon_enough_to_tell) {
      const auto end = std::time(nullptr) + static_cast<std::time_t>(plan.seconds);
      fmt::print("until {:%H:%M:%S} at the latest\n", *std::localtime(&end));
    } else {
      fmt::print("until done\n");
    }
    fmt::print("{}\nwrites {}\n",
               request_.detector.built_in ? "detector built-in" : plugin_text(request_), out_);
    std::fflush(stdout);
  }

  void on_phase(const char* phase) override {
    phase_began_ = std::chrono::steady_clock::now();
    progress_.emplace(phase);
  }

  void on_canary(const properties::Canary& canary) override {
    fmt::print("canary {}: {}\n", canary.fault,
               canary.found_after ? fmt::format("found after {} cases", *canary.found_after)
                                  : "NOT FOUND: the harness sees nothing");
    std::fflush(stdout);
  }

  void on_trial(const properties::TrialProgress& state) override {
    progress_->show(
        fmt::format("{}/{} trials, {} with a defect, {} undecided{}{}{}", state.done_trials,
                    state.quota, state.defects, state.undecided,
                    state.disturbed ? fmt::format(", {} disturbed", state.disturbed) : "",
                    rest_text(state.done_trials - state.stored_trials,
                              state.quota - state.done_trials, seconds_since(phase_began_)),
                    advice(state)));
  }

  void on_trials(const properties::TrialsEnd& end) override {
    progress_.reset();
    if (!end.harness_problem.empty()) fmt::print("harness: {}\n", end.harness_problem);
    if (end.trials > 0) fmt::print("{} trials in {:.1f} s\n", end.trials, end.seconds);
    std::fflush(stdout);
  }

  void on_progress(const std::string& text, std::uint64_t count, std::uint64_t remainder) override {
    progress_->show(text + rest_text(count, remainder, seconds_since(phase_began_)));
  }

  void on_failures_shrunk(const properties::FailureList& failures) override {
    progress_.reset();
    std::string text;
    status_ =
        write_failures(failures, out_,
                       {request_.plugin ? request_.plugin->string() : "", request_.limits.isolation,
                        request_.limits.threads, part_asked_by(request_.plan)},
                       text);
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  // Says whether every failing mesh could be written.
  const Expected<void>& status() const { return status_; }

 private:
  // Returns advice if much of a campaign is undecided: most of its time is the wait for those
  // cases.
  std::string advice(const properties::TrialProgress& state) const {
    constexpr std::uint64_t share = 50;  // one trial in this many
    constexpr double short_limit = 1;
    const bool waits = state.undecided > 1 && state.undecided * share > state.done_trials &&
                       request_.plan.case_seconds > short_limit;
    return waits ? fmt::format(" (each undecided trial takes {:g} s: --case-seconds 1 is quicker)",
                               request_.plan.case_seconds)
                 : "";
  }

  const properties::CampaignRequest& request_;
  const std::string out_;
  std::chrono::steady_clock::time_point phase_began_;
  std::optional<PlainProgress> progress_;
  Expected<void> status_ = outcome::success();
};

}  // namespace

void add_campaign_options(CLI::App& verb, CampaignWords& words) {
  add(verb, "--campaign NAME|FILE", words.campaign,
      "smoke, quick, nightly, release, or a campaign file (.json)")
      ->capture_default_str();
  add_seed(verb, words.seed, "Seed of all random cases; use a fresh seed each night");
  add(verb, "--time SECONDS", words.time_limit,
      "Time limit in seconds by the clock, in place of the campaign's own limit; trials that have "
      "not run by then are missing")
      ->check(positive())
      ->group(OptionGroup::limits);
  add(verb, "--case-seconds SECONDS", words.case_seconds,
      "Limit of processor time for one case, in place of the campaign's own limit (10); a case "
      "that takes longer is undecided")
      ->check(positive())
      ->group(OptionGroup::limits);
  add_choice(verb, "--memory SIZE", words.memory, "a whole number above 0, perhaps with K, M or G",
             memory_size,
             "Limit of address space for the process that runs a case, such as 6GB or 512MB, in "
             "place of the campaign's own limit (4GB); allocations beyond the limit fail")
      ->group(OptionGroup::limits);
  add(verb, "--power DIR", words.power,
      "Folder of a run or certificate of this build, in which the planted faults were found");
  add(verb, "--corpus DIR", words.own_cases,
      "Folder of case files of your own (assay-case/1), judged besides the shipped cases");
  add(verb, "--data DIR", words.data,
      "Folder of the public sequences: a plug-in that claims to be deterministic runs on them too, "
      "several times");
  add_detector(verb, words.detector);
  add_part(verb, words.detector.part);
  add_jobs(verb, words.jobs);
}

Expected<properties::CampaignRequest> ask_for_campaign(const CampaignWords& words) {
  end_when_interrupted(fmt::format("interrupted: all judged trials are stored in {}; run the same "
                                   "command again to go on",
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
      fmt::print("{}: this folder has no case yet\n", words.own_cases);
    } else {
      request.own_cases = std::move(own);
    }
  }
  request.worker = properties::worker_program();  // a proof names it, too
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
    return Problem{
        fmt::format("{}: under its contract no claim can be judged; there is nothing to certify",
                    words.detector.library)};
  const auto& plans = properties::named_plans();
  const bool is_named = std::any_of(plans.begin(), plans.end(),
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
    return Problem{fmt::format(
        "campaign {}: its strata are queries, which only a plug-in can answer", request.plan.name)};
  }
  return request;
}

Expected<void> may_keep_run(const std::filesystem::path& out,
                            const std::vector<std::string>& files) {
  BOOST_OUTCOME_TRY(may_fill(out, files));
  std::error_code ignored;
  if (!std::filesystem::exists(out / "failures", ignored)) return outcome::success();
  return may_fill(out / "failures");
}

Expected<void> run_on_terminal(const properties::CampaignRequest& request, properties::Store& store,
                               const std::string& out) {
  BOOST_OUTCOME_TRY(corpus, shipped_corpus());
  CampaignTerminal terminal(request, out);
  BOOST_OUTCOME_TRY(properties::run_campaign(request, corpus / "curated", store, terminal));
  return terminal.status();
}

}  // namespace assay::reports
