// The shipped corpus and scenes through the detector under test, as evidence of a certificate.
#pragma once

#include <functional>
#include <string>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/evidence.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// Called for each row as it is known. Curated cases: of the built-in detector held to their
// expected facts with every culling; of a plug-in to the oracle under its claims, as scenes are for
// both. One judgement of the oracle serves all configurations.
using OnCorpusRow = std::function<void(const properties::CorpusRow&)>;

// Called for each case that a configuration fails by the oracle, as a trial would be stored.
// Expected facts that the built-in detector fails are told in the row alone.
using OnCorpusFailure = std::function<void(const properties::StoredFailure&)>;

// Refused when the corpus cannot be read. corpus: folder of the curated cases.
Expected<void> check_corpus(const properties::CampaignRequest& request,
                            const std::filesystem::path& corpus, const OnCorpusRow& on_row,
                            const OnCorpusFailure& on_failure);

// The request's own cases, through the worker and held to the oracle whatever detector it is. Their
// ids begin with own_cases_in_id.
void check_own_cases(const properties::CampaignRequest& request, const OnCorpusRow& on_row,
                     const OnCorpusFailure& on_failure);

// A row as the terminal shows it, with a line for each case that fails, and what stands above.
std::string corpus_heading();
std::string corpus_row_text(const properties::CorpusRow& row);

// SHA-256 over names and bytes of the case files.
std::string corpus_digest(const std::filesystem::path& corpus);

}  // namespace assay::reports
