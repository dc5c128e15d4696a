// Which program this is.
#pragma once

#include <string>

namespace assay::reports {

// The commit: 40 hexadecimal digits, followed by "-dirty" if tracked files were changed. Empty if
// the program was built outside of a git repository.
std::string commit_text();

// "assay 0.2.0 (CGAL 5.5.1, GMP ..., ...)": this program and the libraries that its answers rest
// on.
std::string version_text();

}  // namespace assay::reports
