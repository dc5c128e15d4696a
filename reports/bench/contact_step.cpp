#include "reports/bench/contact_step.h"

#include <algorithm>

#include "reports/bench/suites.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

double mean_edge_length(const Triangles& triangles, const Positions& x) {
  double sum = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      sum += (x.row(triangles(t, k)) - x.row(triangles(t, (k + 1) % 3))).norm();
    }
  }
  return sum / (3 * static_cast<double>(triangles.rows()));
}

}  // namespace

std::optional<corpus::Sequence> step_at_first_contact(const std::string& name, int triangles) {
  constexpr int frames = 41;
  const auto scene = bench_scene(name, triangles, frames);
  Options options = bench_options(Culling::view_point);
  options.pairs = Pairs::first;
  auto made = Detector::create(scene.triangles, scene.frames[0], options);
  if (!made) throw UnusableData(name + ": " + made.error().message);
  for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
    const Positions &x0 = scene.frames[f], &x1 = scene.frames[f + 1];
    const StepResult result = made.value().evaluate(x0, x1);
    if (result.answer != Answer::collision) continue;
    const double fastest = (x1 - x0).rowwise().norm().maxCoeff();
    const double half = 0.5 * mean_edge_length(scene.triangles, x0) / fastest;
    const double begin = std::max(0.0, result.first.lo - half), end = result.first.hi + half;
    const Positions a = x0 + begin * (x1 - x0), b = x0 + end * (x1 - x0);
    return corpus::Sequence{scene.triangles, {a, b}};
  }
  return std::nullopt;
}

}  // namespace assay::reports
