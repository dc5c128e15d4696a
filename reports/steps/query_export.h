// Writes an elementary query for the owner of a detector, as plain arrays (owner_export.h does so
// for a case).
#pragma once

#include <string>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/step.h"
#include "properties/claims/contract.h"

namespace assay::reports {

// A self-contained C++ file: the four points at both ends of the step, the exact answer, its time
// as decimals and as fractions; a function that is left to be filled in, and a main() that
// compares. The program's exit codes are 0: right, 1: wrong, 2: not filled in. REQUIRES the case
// of a query (properties/worker/plugin/query_case.h) and its judgement.
std::string plain_query_text(const corpus::Case& c, const properties::Contract& contract,
                             const oracle::StepJudgement& truth);

// A second file, which puts the same arrays to the query of a library that is named to it.
std::string plugin_query_text();

}  // namespace assay::reports
