// What `certify` checks by itself, as evidence of a certificate: the corpus, the oracle, the speed.
#pragma once

#include <functional>
#include <string>

#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/request.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// Is called for each row as soon as it is known. A row sums up all cases of one kind, such as the
// curated ones, in one configuration of the detector.
using OnCorpusRow = std::function<void(const properties::CorpusRow&)>;

// Is called for each case in which a configuration contradicts the oracle. The failure has the form
// in which a trial's failure is stored. A curated case of which only an expected fact fails is told
// of in its row alone.
using OnCorpusFailure = std::function<void(const properties::StoredFailure&)>;

// Runs the curated cases of the folder `corpus`, and the scenes, which are built into the program.
// In curated cases the built-in detector is held to the expected facts, with every culling, and a
// plug-in to the oracle under its claims. In scenes both are held to the oracle, whose judgement of
// a case serves all configurations. Fails if the corpus cannot be read.
Expected<void> check_corpus(const properties::CampaignRequest& request,
                            const std::filesystem::path& corpus, const OnCorpusRow& on_row,
                            const OnCorpusFailure& on_failure);

// Runs the cases that the user added to the campaign (`--corpus DIR`), in a worker. Every detector
// is held to the oracle in them. Their ids begin with own_cases_in_id.
void check_own_cases(const properties::CampaignRequest& request, const OnCorpusRow& on_row,
                     const OnCorpusFailure& on_failure);

// Prints the heading, collects the rows of an input, and prints them when the next input begins or
// `end` is called. If all configurations came to the same, and to nothing that has to be told, they
// share one row.
class CorpusTable {
 public:
  CorpusTable();
  void add(const properties::CorpusRow& row);
  void end();

 private:
  std::vector<properties::CorpusRow> rows_;
};

// Is called for each of properties::speed_figures: a ratio of processor times of interleaved steps
// of the built-in detector. 10 s in all.
using OnSpeedFigure = std::function<void(const properties::SpeedFigure&)>;
void measure_speed(const OnSpeedFigure& on_figure);

}  // namespace assay::reports
