// Runs the shipped corpus and scenes through the detector under test, as evidence of a
// certificate.
#pragma once

#include <functional>
#include <string>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/evidence.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// Is called for each row as soon as it is known. In curated cases the built-in detector is held to
// the expected facts, with every culling, and a plug-in to the oracle under its claims. In scenes
// both are held to the oracle. One judgement of the oracle serves all configurations.
using OnCorpusRow = std::function<void(const properties::CorpusRow&)>;

// Is called for each case that a configuration fails by the oracle, in the form in which a trial's
// failure would be stored. Expected facts that the built-in detector fails appear in the row
// alone.
using OnCorpusFailure = std::function<void(const properties::StoredFailure&)>;

// Fails if the corpus cannot be read. `corpus` is the folder of the curated cases.
Expected<void> check_corpus(const properties::CampaignRequest& request,
                            const std::filesystem::path& corpus, const OnCorpusRow& on_row,
                            const OnCorpusFailure& on_failure);

// Runs the owner's cases of the request through the worker. Every detector is held to the oracle
// in them. Their ids begin with own_cases_in_id.
void check_own_cases(const properties::CampaignRequest& request, const OnCorpusRow& on_row,
                     const OnCorpusFailure& on_failure);

// The text of a row on the terminal, with one line for each case that fails, and the heading above
// the rows.
std::string corpus_heading();
std::string corpus_row_text(const properties::CorpusRow& row);

// SHA-256 over names and bytes of the case files.
std::string corpus_digest(const std::filesystem::path& corpus);

}  // namespace assay::reports
