// What a stored run comes to where no certificate stands beside it: a verdict and its gates.
#pragma once

#include <string>
#include <vector>

#include "reports/page_data/run_folder.h"

namespace assay::reports {

struct Gate {
  std::string name;
  const char* state;  // "passed", "failed", "not judged"
  std::string text;   // one sentence
};

struct RunVerdictText {
  std::string word;  // defect, undecided, unsound-harness, incomplete, holds
  bool certified = false;
  std::string why;          // one sentence
  std::vector<Gate> gates;  // in the order in which they are asked
};

// A run says nothing of corpus and speed, and is never certified: that takes `assay certify`.
RunVerdictText verdict_of(const StoredRun& run);

}  // namespace assay::reports
