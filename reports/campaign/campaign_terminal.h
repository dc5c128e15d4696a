// Runs a campaign on the terminal: the request to `run` and `certify`, the options that state it,
// the display while it runs, and the checks that `certify` makes by itself.
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

// Adds an option for each member but --out and --share, which each verb describes in its own way.
// The campaign that `words` names is the default.
void add_campaign_options(CLI::App& verb, CampaignWords& words);

// Turns the words into a request. From this call on ctrl-C ends the program, and stored rows stay.
// Fails if a name, a file or a library is wrong.
Expected<properties::CampaignRequest> ask_for_campaign(const CampaignWords& words);

// Makes the folder of a run, and checks that these files, and its folder of failures, can be
// written.
Expected<void> may_keep_run(const std::filesystem::path& out,
                            const std::vector<std::string>& files);

// Does the part of the campaign that the store does not hold yet. Prints its plan, its progress and
// the remaining time, and shows the failures, with their files and pictures below `out`, as soon as
// all of them are shrunk. Fails if a file or the store could not be written; stored rows then stay.
Expected<void> run_on_terminal(const properties::CampaignRequest& request, properties::Store& store,
                               const std::string& out);

// Makes the checks of `certify`, as evidence of a certificate: the corpus, the oracle, the speed.

// Rows sum up all cases of one input, such as the curated ones, in one configuration. Failures are
// cases in which a configuration contradicts the oracle, in the stored form of a trial's failure. A
// curated case that only misses an expected fact is named in its row alone.
struct JudgedCorpus {
  std::vector<properties::JudgedSource> rows;
  std::vector<properties::FailureRecord> failures;
};

// Runs the curated cases and queries of the corpus `shipped`, and the scenes, which are built into
// the program, unless it is empty; then the cases that the user added to the campaign
// (`--corpus DIR`). Prints the result of each input. In curated cases the built-in detector is
// compared with the expected facts, with every culling, and a plug-in with the oracle under its
// claims. In scenes, and in the user's cases, whose ids begin with "own/", both are compared with
// the oracle, whose judgement of a case serves all configurations. Fails if the corpus cannot be
// read.
Expected<JudgedCorpus> judge_corpus(const properties::CampaignRequest& request,
                                    const std::filesystem::path& shipped);

// Measures each of properties::speed_figures, a ratio of processor times of interleaved steps of
// the built-in detector, and prints it. 10 s in all.
std::vector<properties::SpeedFigure> measure_speed();

// Finds the cases of a corpus: those shipped with the program, and those in a folder of the
// detector's owner, which `run` and `certify` add.

// Returns the folder of the shipped corpus: curated cases, known failures, the conformance set. It
// lies beside the program, built or installed, so the program holds no path of another machine. The
// environment variable ASSAY_CORPUS names another folder. Fails if there is no such folder.
Expected<std::filesystem::path> shipped_corpus();

// Reads the cases in a folder of the owner: every file whose name ends with .json. Fails if one
// cannot be read, or if there is none.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// Returns the SHA-256 over the names and bytes of these files.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace assay::reports
