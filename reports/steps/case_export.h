// Writes a case for other programs: its frames as OBJ, and C++ that holds the case and checks a
// detector's claims on it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "properties/judging/exam.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// Writes FOLDER/frame_0000.obj ... (with the shortest decimals that read back to the same doubles),
// FOLDER/case.json, FOLDER/case.cpp, and a second C++ file that puts FOLDER/case.cpp to the
// detector.
//
// FOLDER/case.cpp needs C++17 and FOLDER/exported_case.h alone. It holds mesh and frames, or the
// four points of a query (properties/worker/plugin/query_case.h); for each step the oracle's
// contacts that count under the contract, with their times as decimals and as fractions, and the
// other pairs that may be reported; a function to be filled in; and a main() that checks its
// answers for the broken `claim`, or for each claim if none is broken. Other pairs may be reported
// if the contract leaves them out or has a slack. Its exit codes are 0: no claim is broken, 1: one
// is, 2: not filled in.
//
// For a plug-in the second file is FOLDER/case_plugin.cpp, whose program takes a library as its
// word and asks its assay_detector() (exported_plugin.h), once in a process of its own. If `total`
// is checked, the program also ends with 1 if the library crashes or exits. For the built-in
// detector the second file is FOLDER/case_test.cpp, a GoogleTest of the first configuration, which
// needs the library assay::detector.
//
// REQUIRES judgements of a contracted case. Fails if a file cannot be written.
Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth,
                           std::optional<properties::Claim> claim);

}  // namespace assay::reports
