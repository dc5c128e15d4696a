// A run in `assay-report/1`: verdict, gates, strata with bounds, laws, distributions.
#pragma once

#include "reports/page_data/run_folder.h"

namespace assay::reports {

// All of a run but its failures. Fields: reports/README.md.
nlohmann::ordered_json run_json(const StoredRun& run);

// Its strata alone.
nlohmann::ordered_json run_strata(const StoredRun& run);

// How many trials hold a defect, in whatever configuration counts the most of them.
std::uint64_t defect_trials(const StoredRun& run);

}  // namespace assay::reports
