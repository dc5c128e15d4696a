// What a campaign came to, as plain text: a rendering of its findings and gates.
#pragma once

#include <string>

#include "properties/campaign/gates/gates.h"

namespace assay::reports {

// All tables that the findings fill: strata, what the cases were, laws, planted faults, worlds.
std::string findings_text(const properties::RunFindings& findings);

// A row for each gate with its outcome, and below it at most five reasons.
std::string gates_text(const properties::Judgement& judgement);

// "DEFECT: 3 trials with a defect, 0 undecided, 1 laws broken".
std::string verdict_text(const properties::RunFindings& findings,
                         const properties::Judgement& judgement);

}  // namespace assay::reports
