// Writes a case for the owner of a detector, as plain arrays that need neither Assay nor a test
// framework, with a program that asks of a detector what its owner claims.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/step.h"
#include "properties/judging/trial.h"

namespace assay::reports {

// A self-contained C++ file: mesh and frames, or the four points of a query
// (properties/worker/plugin/query_case.h); for each step what the oracle finds that counts under
// the contract, with its time as decimals and as fractions, and the contacts that the contract
// leaves out; the claims; a function that is left to be filled in, and a main() that asks for each
// claim. The program's exit codes are 0: no claim is broken, 1: one is, 2: not filled in. REQUIRES
// a plug-in, and judgements of a contracted case.
std::string plain_case_text(const corpus::Case& c, const properties::DetectorUnderTest& detector,
                            const std::vector<oracle::StepJudgement>& judgements);

// A second file, which puts the same arrays to the assay_detector() of a library that is named to
// it, and asks for the same claims. It ends with 1 too where the library crashes or exits, if
// `total` is claimed.
std::string plugin_case_text(bool is_query);

// "5/8", "3/2^1060": a double in [0, 1] as the fraction that it is.
std::string fraction_of(double share);

}  // namespace assay::reports
