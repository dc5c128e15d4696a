// A case for other programs: its frames as OBJ, and a GoogleTest that holds it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/campaign/trials/trial.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// Writes FOLDER/frame_0000.obj ... (shortest decimals that read back to the same doubles),
// FOLDER/case.json, and of the built-in detector FOLDER/case_test.cpp, a test of it against what
// the oracle found, which needs GoogleTest and the library assay::detector. Of a plug-in:
// FOLDER/case.cpp and FOLDER/case_plugin.cpp (owner_export.h; of a query, query_export.h). Refused
// where a file cannot be written.
Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth);

}  // namespace assay::reports
