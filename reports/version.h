// Which state of the source this program was built from.
#pragma once

#include <string>

namespace assay::reports {

// The commit, 40 hexadecimal digits; "-dirty" behind it where tracked files were changed. Empty
// where it was built outside of a git repository.
std::string commit_text();

}  // namespace assay::reports
