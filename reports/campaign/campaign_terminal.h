// A campaign on the terminal: what `run` and `certify` are asked of it, the options that say it,
// and what is shown while it runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace CLI {
class App;
}  // namespace CLI

namespace assay::reports {

// The request in the user's words.
struct CampaignWords {
  std::string campaign;  // a name or a file
  std::uint64_t seed = properties::default_seed;
  std::optional<double> time_limit;     // seconds of the clock, in place of the campaign's own
  std::optional<double> case_seconds;   // of processor time, in place of the campaign's own
  std::optional<std::uint64_t> memory;  // bytes, in place of the campaign's own
  std::string power;                    // a folder with the proof of planted faults; empty: none
  std::string own_cases;                // a folder of cases of the detector's owner; empty: none
  std::string data;                     // folder of the public data; empty: none of it is repeated
  DetectorWords detector;
  std::string out;
  int jobs = 1;
  std::uint64_t shares = 1;  // 8: an eighth of the campaign is done
};

// Adds an option for each member but --campaign, --out and --share, which each verb describes in
// its own way.
void add_campaign_options(CLI::App& verb, CampaignWords& words);

// From this call on ctrl-C leaves with what is stored. Fails if a name, a file or a library is
// wrong.
Expected<properties::CampaignRequest> ask_for_campaign(const CampaignWords& words);

// Makes the folder of a run, and looks whether these files of it can be written, and its folder of
// failures.
Expected<void> may_keep_run(const std::filesystem::path& out,
                            const std::vector<std::string>& files);

// Does the part of the campaign that the store does not hold yet. Says what it is going to do, how
// far it is and how long that will take, and shows the failures, with their files and pictures
// below `out`, as soon as all of them are shrunk. Fails if a file or the store could not be
// written; what is stored then stays.
Expected<void> run_on_terminal(const properties::CampaignRequest& request, properties::Store& store,
                               const std::string& out);

}  // namespace assay::reports
