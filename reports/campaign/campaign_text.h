// Renders the results of a campaign as plain text: its predicate (certificate/statement.h), or its
// findings and gates where these say more. Writes the files of its failures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
#include "properties/campaign/ledger/store.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// Returns all tables that the findings fill: strata, laws, planted faults, worlds.
std::string findings_text(const properties::RunFindings& findings,
                          const nlohmann::ordered_json& predicate);

// Returns a row for each gate with its outcome, and below it at most five reasons.
std::string gates_text(const properties::Judgement& judgement);

// Returns "DEFECT: 3 trials with a defect, 0 undecided, 1 laws broken".
std::string verdict_text(const properties::RunFindings& findings,
                         const properties::Judgement& judgement);

// Returns "replay OUT/failures/... --detector LIB.so", the words of a line to paste in any folder.
// If `out` is empty, the line is to be pasted in the folder of the run; certificates and pages show
// such words after "assay".
std::string replay_words(const std::filesystem::path& out, const std::filesystem::path& file,
                         const DetectorWords& detector);

// Returns the detector of a run, as a replay line names it.
DetectorWords detector_of(const properties::RunFindings& findings);

// Writes OUT/failures/CASE-CONFIGURATION-original.json and -smallest.json for each stored failure,
// under the same names in every run, and a picture (.svg) of the smallest mesh of each signature.
// Appends to `text` one paragraph about the signature that was met most often: claim, how often,
// both sizes, triangles, feature, and the line that replays it. At most nine other signatures get a
// line each, sorted by the size of their meshes, and chosen so that no broken claim is left out.
// Further signatures are only counted. `detector` is the detector that failed.
Expected<void> write_failures(const properties::FailureList& failure_list,
                              const std::filesystem::path& out, const DetectorWords& detector,
                              std::string& text);

// The largest number of groups of failures that is shown.
inline constexpr std::size_t most_groups_shown = 5;

// Returns the groups of failures (properties/campaign/gates/gates.h), each with its smallest mesh,
// and how many kinds of failure are in other groups. Empty if there are fewer than two kinds.
std::string groups_text(const properties::RunFindings& findings,
                        const nlohmann::ordered_json& predicate);

// Returns the groups of failures, then a paragraph for each signature, with a line for each further
// case of the signature.
std::string failures_text(const properties::RunFindings& findings,
                          const nlohmann::ordered_json& predicate);

// Returns the trials without a verdict, then the slowest of the other trials, each with its
// processor time and the line that replays it.
std::string slow_trials_text(const properties::RunFindings& findings);

}  // namespace assay::reports
