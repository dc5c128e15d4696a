#include "reports/bench/parts/measuring_arena.h"

#include <algorithm>
#include <numeric>
#include <vector>

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

}  // namespace assay::reports
