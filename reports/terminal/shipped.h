// What is shipped with the program and read at run time.
#pragma once

#include <filesystem>

#include "reports/terminal/complaint.h"

namespace assay::reports {

// The folder of the shipped corpus: curated cases, known failures, the conformance set. It lies
// beside the program, as that was built or installed, so the program holds no path of another
// machine. The environment variable ASSAY_CORPUS names another folder. Fails if there is none.
Expected<std::filesystem::path> shipped_corpus();

}  // namespace assay::reports
