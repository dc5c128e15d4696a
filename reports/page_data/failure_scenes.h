// The failures of a stored run, each signature with one mesh that is run again to be shown.
#pragma once

#include "reports/page_data/run_folder.h"

namespace assay::reports {

// `failures` of assay-report/1: one entry a signature, its smallest mesh with scene and picture.
nlohmann::ordered_json failures_json(const StoredRun& run);

}  // namespace assay::reports
