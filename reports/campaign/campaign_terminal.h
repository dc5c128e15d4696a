// A campaign on the terminal: what a verb asks of it, and what is shown while it runs.
#pragma once

#include <optional>
#include <string>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/store.h"

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

// Does all of the campaign that the store does not hold yet. Says what it is going to do, how far
// it is and how long that will take, and shows the failures, with their files and pictures below
// `out`, as soon as all of them are shrunk. A line for the user when a file could not be written,
// or the store could not be: what is stored stays then.
std::optional<std::string> run_on_terminal(const properties::CampaignRequest& request,
                                           properties::Store& store, const std::string& out);

}  // namespace assay::reports
