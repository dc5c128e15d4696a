// The mesh and the steps that `check` is given.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reports/check/checked_steps.h"

namespace assay::reports {

struct CheckInput {
  std::string file;  // the first file
  std::unique_ptr<CheckedSteps> steps;
};

// Takes frames of one mesh (two or more), which are read as their steps come, or reads one case
// file. Fails if its options are not understood. REQUIRES a file.
corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files);

}  // namespace assay::reports
