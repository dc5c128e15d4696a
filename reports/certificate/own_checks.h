// What `certify` checks by itself, as evidence of a certificate: the corpus, the oracle, the speed.
#pragma once

#include <filesystem>
#include <functional>
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

// Is called for each of properties::speed_figures: a ratio of processor times of interleaved steps
// of the built-in detector. 10 s in all.
using OnSpeedFigure = std::function<void(const properties::SpeedFigure&)>;
void measure_speed(const OnSpeedFigure& on_figure);

}  // namespace assay::reports
