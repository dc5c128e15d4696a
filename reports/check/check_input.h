// The mesh and the steps that `check` is given.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/judging/case_check.h"

namespace assay::reports {

struct CheckInput {
  corpus::Case c;    // of frames: one without a view, options or expected facts
  std::string file;  // the first
  bool is_case_file = false;
};

// Frames of one mesh (two or more), or one case file whose options are understood.
corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files);

}  // namespace assay::reports
