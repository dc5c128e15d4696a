// `check --separation D` or `--offset` on one mesh: whether triangles that share no vertex come
// within D of each other, which, when first, and how near any two of them come. The oracle alone is
// asked.
#pragma once

#include "reports/check/check_run.h"

namespace assay::reports {

// Finite lengths of 0 or more, in the mesh's units.
struct AskedDistance {
  double separation = 0;
  // By body. If there are any, the distance asked of two triangles is the exact sum of the offsets
  // of their bodies, in place of `separation`.
  std::vector<double> offsets;
};

struct SeparationAnswer {
  int exit_code = 0;              // 3 if a limit was reached; else 5 if near and asked for; else 0
  nlohmann::ordered_json report;  // schema assay-check/1; null unless wanted
};

// Asks the oracle for each step. Of the question only what bears on the oracle is used: files,
// jobs, limits, and whether a report is wanted. REQUIRES as many offsets as bodies, or none.
// `fail_when_near`: exit code 5 where a step is near.
Expected<SeparationAnswer> check_separation(const CheckQuestion& question, const AskedDistance& d,
                                            bool fail_when_near, CheckInput& input,
                                            const CheckListener& listener);

}  // namespace assay::reports
