// The mesh and the steps that `check` is given.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/judging/case_check.h"

namespace assay::reports {

struct CheckInput {
  corpus::Case c;    // made from frames it has no view, options or expected facts
  std::string file;  // the first file
  bool is_case_file = false;
};

// Reads frames of one mesh (two or more), or one case file. Fails if its options are not
// understood.
corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files);

}  // namespace assay::reports
