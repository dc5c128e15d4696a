// Man pages and completion as files.
#pragma once

#include <string>

#include "reports/terminal/complaint.h"
#include "reports/terminal/manual.h"

namespace assay::reports {

// Writes DIR/man/assay.1, a page for each verb beside it, and DIR/completion/assay.bash and
// DIR/completion/_assay (of zsh). Makes the folders.
Expected<void> write_pages(const std::string& folder, const std::vector<VerbManual>& verbs);

}  // namespace assay::reports
