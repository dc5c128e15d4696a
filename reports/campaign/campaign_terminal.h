// Runs a campaign on the terminal: the request to `run` and `certify`, the options that state it,
// the display while it runs, and the checks that `certify` makes besides the campaign.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/ledger/evidence.h"
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
  std::optional<double> time_limit;     // seconds of the clock, in place of the campaign's limit
  std::optional<double> case_seconds;   // of processor time, in place of the campaign's limit
  std::optional<std::uint64_t> memory;  // bytes, in place of the campaign's limit
  std::string power;                    // a folder with the proof of planted faults; empty: none
  std::string own_cases;                // a folder of cases of the detector's owner; empty: none
  // Folder of the public data. Its sequences are given to a plug-in besides the scenes
  // (CampaignRequest::repeated). Empty: a plug-in gets no public data.
  std::string data;
  DetectorWords detector;
  std::string out;
  int jobs = 1;
  std::uint64_t shares = 1;  // 8: an eighth of the campaign is done
};

// Adds an option for each member of `words`, without --out and --share, which each verb describes
// in its own way. The campaign that `words` names is the default.
void add_campaign_options(CLI::App& verb, CampaignWords& words);

// Turns the words into a request. From this call on ctrl-C ends the program, and stored rows stay.
// Fails if a name, a file or a library is wrong.
Expected<properties::CampaignRequest> ask_for_campaign(const CampaignWords& words);

// Makes the folder of a run, and checks that these files, and its folder of failures, can be
// written.
Expected<void> may_keep_run(const std::filesystem::path& out,
                            const std::vector<std::string>& files);

// Does the part of the campaign that the store does not hold yet. Prints its plan, its progress and
// the remaining time. As soon as all failures are shrunk, shows them, and writes their files and
// pictures below `out`. Fails if a file or the store cannot be written; stored rows then stay.
Expected<void> run_on_terminal(const properties::CampaignRequest& request, properties::Store& store,
                               const std::string& out);

// Makes the two checks, of the corpus and of the speed, that `certify` adds to the evidence.

// A row sums up all cases of one input, such as the curated cases, in one configuration. A failure
// is a case in which a configuration contradicts the oracle, in the stored form of a trial's
// failure. A curated case that only breaks an expected fact is named in its row, and is not a
// failure.
struct JudgedCorpus {
  std::vector<properties::JudgedSource> rows;
  std::vector<properties::FailureRecord> failures;
};

// Runs the curated cases and queries of the corpus `shipped`, and the scenes, which are built into
// the program; an empty `shipped` leaves these out. Then runs the cases that the user added to the
// campaign (`--corpus DIR`), whose ids begin with "own/". Prints the result of each input. In
// curated cases the built-in detector, with every culling, is compared with the expected facts, and
// a plug-in with the oracle under the plug-in's claims. In scenes and in the user's cases, every
// detector is compared with the oracle, which judges a case once for all configurations. Fails if
// the corpus cannot be read.
Expected<JudgedCorpus> judge_corpus(const properties::CampaignRequest& request,
                                    const std::filesystem::path& shipped);

// Measures and prints properties::speed_figures. Each figure is a ratio of processor times of
// interleaved steps of the built-in detector. Takes 10 s in all.
std::vector<properties::SpeedFigure> measure_speed();

// Finds the cases of a corpus: the cases shipped with the program, and the cases in a folder of the
// detector's owner, which `run` and `certify` judge too.

// Returns the folder of the shipped corpus: curated cases, known failures, the conformance set. The
// folder lies beside the program, as built or as installed, so the program contains no path of the
// machine that built it. The environment variable ASSAY_CORPUS names another folder. Fails if the
// folder does not exist.
Expected<std::filesystem::path> shipped_corpus();

// Reads the cases in a folder of the detector's owner: every file whose name ends with .json. A
// folder that does not exist has no cases. Fails if a file cannot be read.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// Returns the SHA-256 over the names and bytes of these files.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace assay::reports
