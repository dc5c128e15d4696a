// A case for the owner of a detector: plain arrays that need neither Assay nor a test framework.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/step.h"
#include "properties/claims/contract.h"

namespace assay::reports {

// A C++ file of its own: mesh, frames and, for each step, the exact answer, its time as decimals
// and as fractions, and the pairs that count under the contract; a function that is left to be
// filled in, and a main() that compares. Exit codes of it: 0 right, 1 wrong, 2 not filled in.
std::string plain_case_text(const corpus::Case& c, const properties::Contract& contract,
                            const std::vector<oracle::StepJudgement>& truth);

// A second file, which puts the same arrays to the assay_detector() of a library that it is given.
std::string plugin_case_text();

// "5/8", "3/2^1060": a double in [0, 1] as the fraction that it is.
std::string fraction_of(double share);

}  // namespace assay::reports
