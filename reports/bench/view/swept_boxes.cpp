#include "reports/bench/view/swept_boxes.h"

#include <algorithm>

namespace assay::reports {

void write_swept_boxes(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                       const detector::PositionsView& x_t1, std::vector<SweptBox>& boxes) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double a0 = x_t0(v[0], k), b0 = x_t0(v[1], k), c0 = x_t0(v[2], k);
      const double a1 = x_t1(v[0], k), b1 = x_t1(v[1], k), c1 = x_t1(v[2], k);
      boxes[t][static_cast<std::size_t>(k)] =
          std::min(std::min(std::min(a0, b0), std::min(c0, a1)), std::min(b1, c1));
      boxes[t][static_cast<std::size_t>(k) + 3] =
          std::max(std::max(std::max(a0, b0), std::max(c0, a1)), std::max(b1, c1));
    }
  }
}

}  // namespace assay::reports
