// Writes a case for other programs: its frames as OBJ, and C++ that holds it and asks of a detector
// what is claimed of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "properties/judging/exam.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// Writes FOLDER/frame_0000.obj ... (with the shortest decimals that read back to the same doubles),
// FOLDER/case.json, FOLDER/case.cpp, and a second C++ file that puts FOLDER/case.cpp to the
// detector.
//
// FOLDER/case.cpp needs C++17 and FOLDER/exported_case.h alone. It holds mesh and frames, or the
// four points of a query (properties/worker/plugin/query_case.h); for each step what the oracle
// finds that counts under the contract, with its time as decimals and as fractions, and what else
// may be reported, because the contract leaves it out or has a slack; a function that is left to be
// filled in, and a main() that asks its answers for the broken `claim`, or for each claim if none
// is broken. Its exit codes are 0: no claim is broken, 1: one is, 2: not filled in.
//
// For a plug-in the second file is FOLDER/case_plugin.cpp, whose program takes a library as its
// word and asks its assay_detector() (exported_plugin.h), once in a process of its own. If `total`
// is asked, it also ends with 1 where the library crashes or exits. For the built-in detector it is
// FOLDER/case_test.cpp, a GoogleTest of the first configuration, which needs the library
// assay::detector.
//
// REQUIRES judgements of a contracted case. Fails if a file cannot be written.
Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth,
                           std::optional<properties::Claim> claim);

}  // namespace assay::reports
