// Writes a case for the owner of a detector, as plain arrays that need neither Assay nor a test
// framework.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/step.h"
#include "properties/claims/contract.h"

namespace assay::reports {

// A self-contained C++ file: mesh, frames and, for each step, the exact answer, its time as
// decimals and as fractions, and the pairs that count under the contract; a function that is left
// to be filled in, and a main() that compares. The program's exit codes are 0: right, 1: wrong, 2:
// not filled in.
std::string plain_case_text(const corpus::Case& c, const properties::Contract& contract,
                            const std::vector<oracle::StepJudgement>& truth);

// A second file, which puts the same arrays to the assay_detector() of a library that is named to
// it.
std::string plugin_case_text();

// "5/8", "3/2^1060": a double in [0, 1] as the fraction that it is.
std::string fraction_of(double share);

}  // namespace assay::reports
