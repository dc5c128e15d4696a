// Suite `view` measures what the view test and a free step take, and how tight the view sets are.
#include "reports/bench/view/view_parts.h"

namespace assay::reports {

BenchReport view_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report("view");
  progress.phase("view test against swept boxes");
  time_view_test(settings, report);
  progress.phase("free steps");
  time_free_steps(settings, report);
  progress.phase("view sets against the oracle's");
  measure_tightness(settings, report);
  return report;
}

}  // namespace assay::reports
