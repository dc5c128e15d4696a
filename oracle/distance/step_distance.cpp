#include "oracle/distance/step_distance.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

namespace assay::oracle {

namespace {

using detector::SteppedMesh;
using detector::TrianglesView;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double greatest = std::numeric_limits<double>::max();

// Returns half of d or more. Halves of denormals, and sums, are rounded by one unit at most.
double half_of(const Separation& d) {
  const double half = d.first / 2 + d.second / 2;
  return d.first == 0 && d.second == 0 ? 0 : std::nextafter(half, infinity);
}

// Returns the box over the step, grown: boxes of features within d meet if each is grown by half of
// d, or by its own offset. No box reaches beyond the greatest double, because no coordinate does.
BoxOfVertices grown_boxes(const SteppedMesh& motion, double half,
                          const std::vector<double>& offsets) {
  return [boxes = swept_boxes(motion), half, &offsets](std::span<const std::int32_t> vertices) {
    Box box = boxes(vertices);
    const double by = offsets.empty() ? half : offsets[detector::at(vertices[0])];
    if (by == 0) return box;
    for (int k = 0; k < 3; ++k) {
      box.min[k] = std::max(-greatest, std::nextafter(box.min[k] - by, -infinity));
      box.max[k] = std::min(greatest, std::nextafter(box.max[k] + by, infinity));
    }
    return box;
  };
}

StepFeatures features_of(const SteppedMesh& motion, const TrianglesView& triangles,
                         const DistanceOptions& options) {
  return {motion, triangles, options, options.neighbours, options.also_asked};
}

StepJudgement judge(const StepFeatures& features, const SteppedMesh& motion, const Separation& d,
                    const std::vector<double>& offsets, StopGate& gate) {
  const auto answer = [&](const detector::FourPoints& points, const detector::Feature& feature) {
    Separation within = d;
    if (!offsets.empty()) {
      const auto offset = [&](int i) { return offsets[detector::at(feature.vertices[i])]; };
      within = {offset(0), offset(points.first_group)};
    }
    return first_time_within(points, within);
  };
  return features.judge(grown_boxes(motion, half_of(d), offsets), gate, answer);
}

// Returns the longest side of the box of all vertices over the step, or the greatest double.
double extent(const SteppedMesh& motion) {
  double longest = 0;
  for (int k = 0; motion.size() > 0 && k < 3; ++k) {
    const auto &from = motion.vertices_t0.col(k), &to = motion.vertices_t1.col(k);
    longest = std::max(longest, std::max(from.maxCoeff(), to.maxCoeff()) -
                                    std::min(from.minCoeff(), to.minCoeff()));
  }
  return std::min(longest, greatest);
}

void lower_to(std::atomic<double>& least, double value) {
  double now = least.load();
  while (value < now && !least.compare_exchange_weak(now, value)) {
  }
}

}  // namespace

StepJudgement judge_distance(const SteppedMesh& motion, const TrianglesView& triangles,
                             const Separation& d, const DistanceOptions& options) {
  StopGate gate(options.stop);
  return judge(features_of(motion, triangles, options), motion, d, options.offsets, gate);
}

LeastDistance least_distance(const SteppedMesh& motion, const TrianglesView& triangles,
                             const DistanceOptions& options) {
  const StepFeatures features = features_of(motion, triangles, options);
  std::atomic<double> least = infinity;
  StopGate gate(options.stop);
  const Workers workers{std::max(options.jobs, 1), &gate};
  features.for_each_pierced_at_start(
      workers, [&](std::int32_t, std::int32_t, const detector::Feature&, int) { least = 0; });
  // Looks among pairs within a distance, and then within a greater one. Two vertices are never
  // farther apart than twice the extent. The order in which threads work does not change the least
  // distance.
  constexpr double first_share = 0x1p-16, growth = 16;
  const double most = std::min(2 * extent(motion), greatest);
  for (double within = most * first_share; least > within && !gate.stopped();
       within = std::max(within * growth, std::numeric_limits<double>::denorm_min())) {
    features.for_each(grown_boxes(motion, half_of({within, 0}), {}), workers,
                      [&](const FeaturePair& pair, int) {
                        const double now = least;
                        if (now == 0) return;
                        const double nearer = now > within ? within : std::nextafter(now, 0);
                        const auto points = points_of(motion, pair.feature);
                        constexpr auto want = detector::Want::yes_no;
                        if (!first_time_within(points, {nearer, 0}, want).contact) return;
                        if (features.some_pair_counts(pair))
                          lower_to(least, least_distance(points));
                      });
    if (within >= most) break;
  }
  LeastDistance result;
  if (gate.was_stopped()) return result;
  result.complete = true;
  result.distance = least;
  if (least == infinity) return result;
  const StepJudgement there = judge(features, motion, {least, 0}, {}, gate);
  result.complete = there.complete;
  if (!there.complete) return result;
  assert(!there.pairs.empty());
  result.where = there.pairs.front();
  return result;
}

}  // namespace assay::oracle
