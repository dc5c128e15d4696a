#include "reports/bench/parts/measuring_arena.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "detector/mesh/for_all.h"
#include "reports/bench/interleave.h"

namespace assay::reports {
namespace {

class MeasuringArena : public detector::ThreadArena {
 public:
  MeasuringArena(std::size_t lanes, MeasuredLoops& measured) : lanes_(lanes), measured_(measured) {}

  void run(std::size_t count, const Work& work) override {
    std::vector<double> busy(lanes_, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const auto lane = std::min_element(busy.begin(), busy.end());
      const auto number = static_cast<std::size_t>(lane - busy.begin());
      *lane += wall_ns_of([&] { work.run(i, number); });
    }
    measured_.pieces += std::accumulate(busy.begin(), busy.end(), 0.0);
    measured_.longest_lanes += *std::max_element(busy.begin(), busy.end());
  }

 private:
  const std::size_t lanes_;
  MeasuredLoops& measured_;
};

}  // namespace

std::unique_ptr<detector::ThreadArena> make_measuring_arena(std::size_t lanes,
                                                            MeasuredLoops& measured) {
  return std::make_unique<MeasuringArena>(lanes, measured);
}

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
