// `check --separation D` on one mesh: whether triangles that share no vertex come within D of each
// other, which, when first, and how near any two of them come. The oracle alone is asked.
#pragma once

#include "reports/check/check_run.h"

namespace assay::reports {

struct SeparationAnswer {
  int exit_code = 0;              // 3 if a limit was reached; else 5 if near and asked for; else 0
  nlohmann::ordered_json report;  // schema assay-check/1; null unless wanted
};

// Asks the oracle for each step. Of the question only what bears on the oracle is used: files,
// jobs, limits, and whether a report is wanted. `separation` is in the mesh's units; REQUIRES that
// it is finite and >= 0. `fail_when_near`: exit code 5 where a step is near.
Expected<SeparationAnswer> check_separation(const CheckQuestion& question, double separation,
                                            bool fail_when_near, CheckInput& input,
                                            const CheckListener& listener);

}  // namespace assay::reports
