#include "reports/bench/view/plain_pass.h"

#include <numeric>
#include <vector>

#include "detector/parallel/for_all.h"

namespace assay::reports {

double read_plainly(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                    const detector::PositionsView& x_t1, const detector::Workers& workers) {
  std::vector<double> sums(workers.count(), 0);
  workers.share_out(mesh.triangles.size(), detector::shared_piece,
                    [&](const detector::LoopPiece& piece) {
                      double sum = 0;
                      for (std::size_t t = piece.begin; t < piece.end; ++t) {
                        for (const auto v : mesh.triangles[t]) {
                          for (Eigen::Index k = 0; k < 3; ++k) sum += x_t0(v, k) + x_t1(v, k);
                        }
                      }
                      sums[piece.lane] += sum;
                    });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace assay::reports
