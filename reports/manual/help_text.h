// Help as text for a terminal of 80 columns.
#pragma once

#include "reports/terminal/manual.h"

namespace assay::reports {

// All verbs.
std::string help_text(const std::vector<VerbManual>& verbs);
// One verb: its options in groups, examples, exit codes.
std::string help_text(const VerbManual& verb);

// What is said of an option, with the words that it may be and its default.
std::string about_with_words(const OptionManual& option);

}  // namespace assay::reports
