// What `certify` checks by itself, as evidence of a certificate: the corpus, the oracle, the speed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/request.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// Rows sum up all cases of one input, such as the curated ones, in one configuration. The failures
// are those in which a configuration contradicts the oracle, in the form in which a trial's failure
// is stored. A curated case of which only an expected fact fails is told of in its row alone.
struct JudgedCorpus {
  std::vector<properties::JudgedSource> rows;
  std::vector<properties::StoredFailure> failures;
};

// Runs the curated cases and queries of the corpus `shipped`, and the scenes, which are built into
// the program, unless it is empty; then the cases that the user added to the campaign
// (`--corpus DIR`). Prints what each input comes to. In curated cases the built-in detector is held
// to the expected facts, with every culling, and a plug-in to the oracle under its claims. In
// scenes, and in the user's cases, whose ids begin with "own/", both are held to the oracle, whose
// judgement of a case serves all configurations. Fails if the corpus cannot be read.
Expected<JudgedCorpus> judge_corpus(const properties::CampaignRequest& request,
                                    const std::filesystem::path& shipped);

// Measures each of properties::speed_figures, a ratio of processor times of interleaved steps of
// the built-in detector, and prints it. 10 s in all.
std::vector<properties::SpeedFigure> measure_speed();

// Where the cases of a corpus lie: what is shipped with the program, and a folder of the detector's
// owner, which `run` and `certify` take beside it.

// The folder of the shipped corpus: curated cases, known failures, the conformance set. It lies
// beside the program, as that was built or installed, so the program holds no path of another
// machine. The environment variable ASSAY_CORPUS names another folder. Fails if there is none.
Expected<std::filesystem::path> shipped_corpus();

// The cases of a folder of the owner: every file of it that ends with .json.
// Fails if one cannot be read, or if there is none.
Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder);

// SHA-256 over the names and bytes of these files.
std::string digest_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace assay::reports
