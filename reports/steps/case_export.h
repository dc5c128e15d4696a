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
// FOLDER/case.json, FOLDER/case.cpp, and a second C++ file whose program asks the detector about
// the case.
//
// FOLDER/case.cpp needs only C++17 and FOLDER/exported_case.h. It holds mesh and frames, or the
// four points of a query (properties/worker/plugin/query_case.h); for each step the oracle's
// contacts that count under the contract, with their times as decimals and as fractions, and the
// other pairs that may be reported; a function that the user fills in; and a main() that checks the
// function's answers against the broken `claim`, or against each claim if `claim` is empty. Another
// pair may be reported if it is a contact that the contract leaves out, or if it comes within the
// contract's slack. Exit codes are 0: no claim is broken, 1: a claim is broken, 2: the function is
// not filled in.
//
// For a plug-in the second file is FOLDER/case_plugin.cpp, whose program takes the path of a
// library, and asks the library's assay_detector() (exported_plugin.h), once in a process of its
// own. If the claim `total` is checked, the exit code is also 1 if the library crashes or exits.
// For the built-in detector the second file is FOLDER/case_test.cpp, a GoogleTest of the first
// configuration, which needs the library assay::detector.
//
// REQUIRES a case that is fitted to the contract, and the oracle's judgement of each of its steps.
// Fails if a file cannot be written.
Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth,
                           std::optional<properties::Claim> claim);

}  // namespace assay::reports
