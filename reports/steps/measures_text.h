// What a plug-in does whatever it claims, as a table for the terminal.
#pragma once

#include <string>

#include "properties/campaign/gates/findings.h"

namespace assay::reports {

// A row for each stratum and one for all of them: false alarms with their interval, misses,
// spurious pairs, how late and how early times are, what the contract leaves out. Then the claims
// that were not judged. Empty for the built-in detector.
std::string measures_text(const properties::RunFindings& findings);

// The same for a few steps, in words: "1 of 2 free steps answered collision; 28874 spurious pairs;
// ...". Empty if there is nothing to say.
std::string measures_sentence(const properties::StepMeasures& measures);

// The columns of one row, without its name.
std::string measures_row(const properties::StepMeasures& measures);
std::string measures_head();

}  // namespace assay::reports
