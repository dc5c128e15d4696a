// The phases of a campaign in one shard: canary, trials, shrinking, planted faults, the exhaustive
// worlds; each leaves its evidence in the store.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/campaign_facts.h"
#include "reports/campaign_text.h"

namespace assay::reports {

struct CampaignResults {
  properties::CanaryResult canary;
  properties::TrialsEnd trials;
  std::vector<properties::FaultResult> faults;  // of this shard
  bool time_for_faults = true;                  // the hunt had all the time that it wanted
  WorldResults worlds;                          // of this shard
  properties::Tally tally;                      // of everything in the store
  double seconds = 0;
};

// What a verb asks of a campaign, with the whole of it as its shard. ctrl-C leaves from then on
// with what is stored, and `out` is made. A line for the user where a name, a file or a library is
// wrong.
struct CampaignWords {
  std::string campaign;  // a name or a file
  std::uint64_t seed = 1;
  int jobs = 1;
  std::string detector;  // a plug-in's library; empty: the built-in detector
  std::string out;
};
std::optional<std::string> ask_for_campaign(const CampaignWords& words,
                                            properties::CampaignRequest& request);

// Runs what is not stored yet, says what it does, prints the tables, and writes the failing meshes
// below `out`. A line for the user when a file could not be written: what is stored stays then.
// Faults and worlds are shared out among shards by their place in the list. Throws StoreProblem.
std::optional<std::string> run_phases(const properties::CampaignRequest& request,
                                      properties::Store& store, const std::string& out,
                                      CampaignResults& results);

}  // namespace assay::reports
