// The break-even scatter as a picture: time over that of culling bvh against the share of V+.
#pragma once

#include <string>
#include <vector>

#include "reports/bench/bench_report.h"

namespace assay::reports {

// SVG 1.1, no script, no font of its own. The ratio on a logarithmic axis with a line at 1, a
// colour for each scene, discs for view-point and squares for view-line.
std::string scatter_svg(const std::vector<ScatterPoint>& points);

}  // namespace assay::reports
