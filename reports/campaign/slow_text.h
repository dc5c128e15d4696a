// Writes the files of a run's slow cases, and the text that is printed about them.
#pragma once

#include <filesystem>
#include <string>

#include "properties/campaign/gates/findings.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// Writes two files for each case that was kept, OUT/slow/ID-CONFIGURATION-original.json and
// -smallest.json, and a picture of the smaller one.
Expected<void> write_slow_cases(const std::vector<properties::SlowCase>& cases,
                                const std::filesystem::path& out);

// The trials without a verdict, then the slowest of the others. Each has its processor time, the
// line that replays it and, if one was kept, the smallest mesh and its picture.
std::string slow_trials_text(const properties::RunFindings& findings);

}  // namespace assay::reports
