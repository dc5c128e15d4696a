// A campaign on the terminal: what a verb asks of it, and what is shown while it runs.
#pragma once

#include <optional>
#include <string>

#include "properties/campaign/phases.h"
#include "reports/plain_progress.h"

namespace assay::reports {

// What a verb asks of a campaign, in the user's words.
struct CampaignWords {
  std::string campaign;  // a name or a file
  std::uint64_t seed = 1;
  int jobs = 1;
  std::string detector;  // a plug-in's library; empty: the built-in detector
  std::string out;
  std::string power;                 // a folder with the proof of planted faults; empty: none
  std::optional<double> time_limit;  // seconds of the clock, in place of the campaign's own
};

// The request for all of a campaign as one shard; `out` is made. ctrl-C leaves from then on with
// what is stored. A line for the user where a name, a file or a library is wrong.
std::optional<std::string> ask_for_campaign(const CampaignWords& words,
                                            properties::CampaignRequest& request);

// Says what the campaign is going to do, how far it is and how long that will take, and shows the
// failures, with their files and pictures below `out`, as soon as all of them are shrunk.
class CampaignTerminal : public properties::CampaignObserver {
 public:
  CampaignTerminal(const properties::CampaignRequest& request, const properties::Store& store,
                   std::string out);

  void on_phase(const char* phase) override;
  void on_canary(const properties::Canary& canary) override;
  void on_trial(const properties::TrialProgress& state) override;
  void on_trials(const properties::TrialsEnd& end) override;
  void on_shrinking(const std::string& signature) override;
  void on_failures_shrunk() override;
  void on_hunt(const properties::HuntProgress& state) override;
  void on_fault_shrunk(const std::string& fault) override;
  void on_world(const std::string& world) override;

  // Why a failing mesh could not be written.
  const std::optional<std::string>& problem() const { return problem_; }

 private:
  void announce() const;

  const properties::CampaignRequest& request_;
  const properties::Store& store_;
  const std::string out_;
  std::chrono::steady_clock::time_point phase_began_;
  std::optional<PlainProgress> progress_;
  std::optional<std::string> problem_;
};

// Does all of the campaign that the store does not hold yet, on the terminal. A line for the user
// when a file could not be written: what is stored stays then. Throws StoreProblem.
std::optional<std::string> run_on_terminal(const properties::CampaignRequest& request,
                                           properties::Store& store, const std::string& out);

}  // namespace assay::reports
