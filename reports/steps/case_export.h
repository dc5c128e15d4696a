// Writes a case for other programs: its frames as OBJ, and a GoogleTest that holds it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/judging/trial.h"
#include "reports/terminal/complaint.h"

namespace assay::reports {

// Writes FOLDER/frame_0000.obj ... (with the shortest decimals that read back to the same doubles)
// and FOLDER/case.json. For the built-in detector also FOLDER/case_test.cpp, which asks of it what
// its first configuration claims, by what the oracle found, and needs GoogleTest and the library
// assay::detector. For a plug-in also FOLDER/case.cpp and FOLDER/case_plugin.cpp (owner_export.h).
// Fails if a file cannot be written.
Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth);

}  // namespace assay::reports
