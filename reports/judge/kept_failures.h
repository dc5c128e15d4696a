// What is kept of steps that fail: of each the part of the mesh that shows it, as files that other
// programs read (steps/case_export.h).
#pragma once

#include <string>

#include "reports/check/check_run.h"

namespace assay::reports {

// What is to be kept of the steps that fail, and where.
struct Keeping {
  std::string folder;          // step N, from 1, goes into FOLDER/step-N; empty: nothing is kept
  std::string origin;          // the input, for people
  double shrink_seconds = 20;  // for each failing step that the plug-in fails on again
};

// Checks one mesh (check_run.h) and keeps what fails. With a plug-in in the question, which a log
// is of the same code as, that is asked about each step alone, and what it fails on is shrunk.
Expected<CheckAnswer> check_keeping(const CheckQuestion& question, CheckInput& input,
                                    const Keeping& keeping, CheckListener listener);

}  // namespace assay::reports
