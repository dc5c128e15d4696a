// The detector that a run is about: the built-in one, or a plug-in; and what a plug-in says of
// itself, for people.
#pragma once

#include <filesystem>
#include <string>

#include "properties/campaign/request.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// The parts of a plug-in that a plan is about: steps, queries, or both.
DetectorPart part_asked_by(const properties::CampaignPlan& plan);

// The detector that the words name. `limits` are those of its processes, but for the isolation and
// the threads of the words; `worker` is the program assay-worker. Fails as Subject::open does.
Expected<properties::Subject> choose_detector(
    const DetectorWords& words, properties::WorkerLimits limits = {},
    const std::filesystem::path& worker = properties::worker_program());

// Its name, its claims and its contract: one line each, without a newline at the end.
std::string detector_text(const properties::DetectorUnderTest& detector);
// "plug-in NAME VERSION", its claims, its contract, its isolation, and the threads that it may
// use: one line each, without a newline at the end.
std::string plugin_text(const properties::Subject& plugin);

// "  it printed:" and the lines that it printed in a case, each behind four blanks; empty if it
// printed nothing.
std::string printed_text(const std::string& printed);

}  // namespace assay::reports
