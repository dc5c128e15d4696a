// What the failures of a run have in common, and what few of the cases that hold have: there one
// change may mend them all, however many kinds of failure it is shown as.
#pragma once

#include <string>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

// "all 57 kinds that lose a contact: between two components (1 of 100 cases that hold has such a
// contact)", a line; empty if the contacts that were lost share nothing telling.
//
// A kind loses a contact if the detector answered free, was late, or left out a pair. The traits of
// a contact are its features and its cause (cause.h), whether it lies within a component or between
// two, and of its mesh whether that is closed and at least how many triangles it has. Told are
// traits that all lost contacts have and at most half of the cases that hold, of a hundred over the
// whole run: there the detector was right. They are not told if as many failing cases might have
// them by chance: if their share to that power is above 1e-4. Deterministic; the oracle judges the
// cases that hold again, which takes seconds. REQUIRES the stores of the findings.
std::string shared_traits_text(const RunFindings& findings);

}  // namespace assay::properties
