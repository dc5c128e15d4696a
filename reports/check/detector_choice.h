// The detector that a run is about: the built-in one, or a plug-in; and what a plug-in says of
// itself, for people.
#pragma once

#include <cstdint>
#include <string>

#include "properties/campaign/request.h"
#include "properties/claims/claims.h"
#include "properties/worker/isolation/isolation.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// The parts of a plug-in that a plan is about: steps, queries, or both.
DetectorPart part_asked_by(const properties::CampaignPlan& plan);

// The detector that the words name. `folder` is that of a run, in which a plug-in reads no file.
// Fails if the library cannot serve, does not hold the part that is asked for, or cannot be
// isolated although that is required.
Expected<properties::Subject> choose_detector(const DetectorWords& words,
                                              const std::filesystem::path& folder = {});

// "plug-in NAME VERSION", its claims, its contract, its isolation, and the threads that it may
// use: one line each, without a newline at the end.
std::string plugin_text(const std::string& name_and_version, const properties::Claims& claims,
                        const properties::Contract& contract,
                        const properties::Isolation& isolation, std::uint64_t threads);

// "  it printed:" and the lines that it printed in a case, each behind four blanks; empty if it
// printed nothing.
std::string printed_text(const std::string& printed);

}  // namespace assay::reports
