// Scripts that complete verbs, options and their words in a shell.
#pragma once

#include "reports/terminal/manual.h"

namespace assay::reports {

std::string bash_completion(const std::vector<VerbManual>& verbs);
std::string zsh_completion(const std::vector<VerbManual>& verbs);

}  // namespace assay::reports
