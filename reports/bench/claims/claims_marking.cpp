#include <fmt/format.h>

#include "detector/search/bounding_volume_tree.h"
#include "detector/search/marking.h"
#include "detector/search/pair_rule.h"
#include "properties/judging/case_options.h"
#include "reports/bench/claims/claims_parts.h"
#include "reports/bench/interleave.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

// Sorts triangles into types as the detector does before its search.
std::vector<TriangleType> types_of(const StepResult& result, std::size_t triangles) {
  std::vector<TriangleType> types;
  for (std::size_t t = 0; t < triangles; ++t) {
    types.push_back((result.doubts[t] & doubt::dirty) != 0      ? TriangleType::dirty
                    : (result.doubts[t] & doubt::violated) != 0 ? TriangleType::violated
                    : result.signs[t] == ViewSign::positive     ? TriangleType::positive
                    : result.signs[t] == ViewSign::negative     ? TriangleType::negative
                                                                : TriangleType::zero);
  }
  return types;
}

}  // namespace

void measure_marking(const BenchSettings& settings, BenchReport& report) {
  for (const std::string name : {"dented-sphere", "crumpling-sphere"}) {
    constexpr int frames = 41;
    const auto scene = bench_scene(name, settings.triangles(20'000), frames);
    auto made =
        Detector::create(scene.triangles, scene.frames[0], bench_options(Culling::view_point));
    if (!made) throw UnusableData(name + ": " + made.error().message);
    Detector& detector = made.value();
    const BoundingVolumeTree tree(detector.topology(), scene.frames[0]);
    Marks marks(tree);
    std::vector<double> shares;
    double changed = 0, touched = 0;
    for (int f = 0; f + 1 < frames; ++f) {
      const auto at = static_cast<std::size_t>(f);
      StepResult result;
      const double step_ns =
          ns_of([&] { result = detector.step(scene.frames[at], scene.frames[at + 1]); });
      if (result.counts.search.box_tests == 0) continue;  // the step is free, so nothing is marked
      const auto types = types_of(result, detector.topology().triangles.size());
      MarkingCounts counts;
      const double ns = ns_of([&] { Marking().bring_to(types, tree, marks, counts); });
      shares.push_back(100 * ns / step_ns);
      changed += static_cast<double>(counts.changed);
      touched += static_cast<double>(counts.marked + counts.cleared);
    }
    if (shares.empty() || changed == 0) continue;
    report.add(fmt::format("marking's share of a step, {}", name), "%", median_of(shares),
               wanted::marking_percent,
               fmt::format("{} steps that search; {} % is read as `low`", shares.size(),
                           wanted::marking_percent.bound));
    report.add(fmt::format("nodes touched for a triangle that changed, {}", name), "nodes",
               exactly(touched / changed), {},
               fmt::format("{:.0f} changes, marked and cleared nodes together", changed));
  }
}

void count_traversals_of_free_steps(const BenchSettings& settings, BenchReport& report) {
  const auto scene = bench_scene("breathing-sphere", settings.triangles(20'000), 11);
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    auto made = Detector::create(scene.triangles, scene.frames[0], bench_options(culling));
    if (!made) throw UnusableData(made.error().message);
    std::size_t free = 0;
    double looks = 0;
    for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
      const auto result = made.value().step(scene.frames[f], scene.frames[f + 1]);
      if (result.counts.free_components == 0) continue;
      ++free;
      const auto& s = result.counts.search;
      looks += static_cast<double>(s.box_tests + s.child_counts + s.candidate_pairs);
    }
    report.add(fmt::format("looks at the tree in free steps, {}", properties::name_of(culling)), "",
               exactly(looks), at_most(0),
               fmt::format("{} of {} steps free by L5", free, scene.frames.size() - 1));
  }
}

}  // namespace assay::reports
