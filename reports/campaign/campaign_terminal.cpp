#include "reports/campaign/campaign_terminal.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/phases/phases.h"
#include "reports/campaign/failure_text.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/progress.h"
#include "reports/terminal/shipped.h"

namespace assay::reports {

using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Gives "; about 40 s left", for example, at the rate so far. Gives nothing before there is a
// rate.
std::string rest_text(std::uint64_t done, std::uint64_t left, double seconds) {
  constexpr double least_seconds = 1;
  if (done == 0 || left == 0 || seconds < least_seconds) return "";
  const double rest = seconds * static_cast<double>(left) / static_cast<double>(done);
  constexpr double minute = 60;
  return rest < 2 * minute ? fmt::format("; about {:.0f} s left", rest)
                           : fmt::format("; about {:.0f} min left", rest / minute);
}

class CampaignTerminal : public properties::CampaignObserver {
 public:
  CampaignTerminal(const properties::CampaignRequest& request, std::string out)
      : request_(request), out_(std::move(out)) {}

  void on_begin(std::uint64_t trials) override { announce(trials); }

  void on_phase(const char* phase) override {
    phase_began_ = Clock::now();
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
        fmt::format("{}/{} trials, {} with a defect, {} undecided{}{}{}", state.done, state.planned,
                    state.defects, state.undecided,
                    state.disturbed ? fmt::format(", {} disturbed", state.disturbed) : "",
                    rest_text(state.done - state.stored, state.planned - state.done,
                              seconds_since(phase_began_)),
                    advice(state)));
  }

  void on_trials(const properties::TrialsEnd& end) override {
    progress_.reset();
    if (!end.harness_problem.empty()) fmt::print("harness: {}\n", end.harness_problem);
    if (end.trials > 0) fmt::print("{} trials in {:.1f} s\n", end.trials, end.seconds);
    std::fflush(stdout);
  }

  void on_search(const properties::SearchProgress& state) override {
    progress_->show(fmt::format("{}/{} lanes, {} cases, {} with a defect", state.lanes,
                                state.planned, state.cases, state.defects));
  }

  void on_shrinking(const std::string& signature) override { progress_->show(signature); }

  void on_failures_shrunk(const properties::KeptFailures& kept) override {
    progress_.reset();
    std::string text;
    written_ =
        write_failures(kept, out_,
                       {request_.plugin ? request_.plugin->string() : "", request_.limits.isolation,
                        request_.limits.threads, part_asked_by(request_.plan)},
                       text);
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  void on_slow_cases(const std::vector<properties::SlowCase>& cases) override {
    progress_.reset();
    if (!written_) return;
    written_ = write_slow_cases(cases, out_);
  }

  void on_hunt(const properties::HuntProgress& state) override {
    const auto seeds = static_cast<std::uint64_t>(state.seeds);
    const auto done = static_cast<std::uint64_t>(state.seed - 1) * state.most_cases + state.cases;
    progress_->show(
        fmt::format("seed {} of {}: {} cases, {} of {} planted faults still hidden{}", state.seed,
                    state.seeds, state.cases, state.hidden, state.planted,
                    rest_text(done, seeds * state.most_cases - done, seconds_since(phase_began_))));
  }

  void on_fault_shrunk(const std::string& fault) override {
    progress_->show(fmt::format("{} shrunk", fault));
  }

  void on_world(const std::string& world) override {
    progress_->show(fmt::format("{}: every motion of a tetrahedron on a small grid", world));
  }

  // Says whether every failing mesh could be written.
  const Expected<void>& written() const { return written_; }

 private:
  // What is long in a campaign of which much is undecided is mostly the wait for those cases.
  std::string advice(const properties::TrialProgress& state) const {
    constexpr std::uint64_t share = 50;  // one in so many
    constexpr double short_limit = 1;
    const bool waits = state.undecided > 1 && state.undecided * share > state.done &&
                       request_.plan.case_seconds > short_limit;
    return waits ? fmt::format(" (each undecided one takes {:g} s: --case-seconds 1 is quicker)",
                               request_.plan.case_seconds)
                 : "";
  }

  void announce(std::uint64_t stored) const {
    const auto& plan = request_.plan;
    const auto planned = properties::planned_trial_count(plan, request_.shares);
    fmt::print("campaign {}, seed {}{}: {} trials of {} families{}, {} configurations", plan.name,
               request_.seed,
               request_.shares > 1 ? fmt::format(", share 1/{}", request_.shares) : "", planned,
               plan.strata.size(),
               stored ? fmt::format(" ({} are stored, {} to do)", stored, planned - stored) : "",
               request_.detector.configurations.size() + request_.detector.of_questions.size());
    if (request_.power) {
      fmt::print("; planted faults as campaign {}, seed {}, of this build found them",
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

  const properties::CampaignRequest& request_;
  const std::string out_;
  Clock::time_point phase_began_;
  std::optional<PlainProgress> progress_;
  Expected<void> written_ = outcome::success();
};

}  // namespace

Expected<void> run_on_terminal(const properties::CampaignRequest& request, properties::Store& store,
                               const std::string& out) {
  BOOST_OUTCOME_TRY(corpus, shipped_corpus());
  CampaignTerminal terminal(request, out);
  BOOST_OUTCOME_TRY(properties::run_campaign(request, corpus / "curated", store, terminal));
  return terminal.written();
}

}  // namespace assay::reports
