#include <fmt/format.h>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/search/marking.h"
#include "detector/search/pair_rule.h"
#include "detector/search/pair_search.h"
#include "detector/step/stages.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/parts/claims_parts.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

Stages stages_that(TreeSearch::Skipping skipping) {
  Stages stages = standard_stages(bench_options(Culling::view_point));
  stages.pair_search = std::make_shared<TreeSearch>(skipping);
  return stages;
}

double box_tests(TimedStep& step) {
  return static_cast<double>(step.result().counts.search.box_tests);
}

void compare_box_tests(const corpus::Case& step, BenchReport& report) {
  const auto& name = step.id;
  const Options with_views = bench_options(Culling::view_point);
  TimedStep bvh(name, step.triangles, step.frames, bench_options(Culling::bvh), report);
  TimedStep plain(name, step.triangles, step.frames, with_views,
                  stages_that(TreeSearch::Skipping::off), report);
  TimedStep compact(name, step.triangles, step.frames, with_views,
                    stages_that(TreeSearch::Skipping::on), report);
  const auto& counts = compact.result().counts.search;
  report.add(fmt::format("box tests of the vBVHs over bvh's, {}", name), "times",
             exactly(box_tests(plain) / box_tests(bvh)), below(1),
             fmt::format("{:.0f} over {:.0f}, V+ {:.1f} %", box_tests(plain), box_tests(bvh),
                         100 * plain.positive_share()));
  report.add(fmt::format("box tests with skipping over without, {}", name), "times",
             exactly(box_tests(compact) / box_tests(plain)), below(1),
             fmt::format("{} tests, {} child counts, {} nodes skipped", counts.box_tests,
                         counts.child_counts, counts.skipped));
}

struct NodePair {
  std::int32_t a, b;
};

// The node pairs that a descent tests, in its order, but at most `most`.
std::vector<NodePair> tested_pairs(const BoundingVolumeTree& tree, std::size_t most) {
  std::vector<NodePair> tested, stack = {{BoundingVolumeTree::root, BoundingVolumeTree::root}};
  while (!stack.empty() && tested.size() < most) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    if (a == b) {
      if (tree.is_leaf(a)) continue;
      const auto child = tree.child(a);
      stack.insert(stack.end(), {{child, child + 1}, {child + 1, child + 1}, {child, child}});
      continue;
    }
    tested.push_back({a, b});
    if (apart(tree.box(a), tree.box(b)) || tree.is_leaf(a) || tree.is_leaf(b)) continue;
    for (const auto i : {tree.child(a), tree.child(a) + 1}) {
      for (const auto j : {tree.child(b), tree.child(b) + 1}) stack.push_back({i, j});
    }
  }
  return tested;
}

// Sorts triangles into types as the detector does before its search.
std::vector<TriangleType> types_of(const StepResult& result) {
  std::vector<TriangleType> types;
  for (std::size_t t = 0; t < result.doubts.size(); ++t) {
    types.push_back((result.doubts[t] & doubt::dirty) != 0      ? TriangleType::dirty
                    : (result.doubts[t] & doubt::violated) != 0 ? TriangleType::violated
                    : result.signs[t] == ViewSign::positive     ? TriangleType::positive
                    : result.signs[t] == ViewSign::negative     ? TriangleType::negative
                                                                : TriangleType::zero);
  }
  return types;
}

// Compares two ways to look at the same node pairs: by their boxes, and by the flags below them.
void compare_a_look(const corpus::Case& step, int rounds, BenchReport& report) {
  const auto& name = step.id;
  TimedStep views(name, step.triangles, step.frames, bench_options(Culling::view_point), report);
  const Topology mesh = make_topology(step.triangles, step.frames[0].rows());
  BoundingVolumeTree tree(mesh, step.frames[0]);
  tree.refit(mesh, {step.frames[0], step.frames[1]});
  tree.join_boxes(nullptr);
  Marks marks(tree);
  MarkingCounts unused;
  Marking().bring_to(types_of(views.result()), tree, marks, unused);
  std::vector<NodePair> pairs;
  constexpr std::size_t most = 500'000;
  for (const auto& pair : tested_pairs(tree, most)) {
    if (!tree.is_leaf(pair.a)) pairs.push_back(pair);
  }
  if (pairs.empty()) return;
  const PairTable k = PairRule().candidates().within;
  const auto flags = [&](std::int32_t node) {
    return marks.node_flags[static_cast<std::size_t>(node)];
  };
  const auto samples = interleave(rounds, {[&] {
                                             std::size_t found = 0;
                                             const double ns = ns_of([&] {
                                               for (const auto& [a, b] : pairs)
                                                 found += apart(tree.box(a), tree.box(b));
                                             });
                                             keep(found);
                                             return ns;
                                           },
                                           [&] {
                                             std::size_t found = 0;
                                             const double ns = ns_of([&] {
                                               for (const auto& [a, b] : pairs) {
                                                 const auto partners = k.partners(flags(b));
                                                 const auto child = tree.child(a);
                                                 found += ((partners & flags(child)) != 0) !=
                                                          ((partners & flags(child + 1)) != 0);
                                               }
                                             });
                                             keep(found);
                                             return ns;
                                           }});
  const double each = 1 / static_cast<double>(pairs.size());
  report.add(
      fmt::format("time of a child count over a box test, {}", name), "times",
      ratio_of(samples[1], samples[0]), below(1),
      fmt::format("{:.2f} ns over {:.2f} ns, {} node pairs", median_of(samples[1]).value * each,
                  median_of(samples[0]).value * each, pairs.size()));
}

}  // namespace

void measure_search(const std::vector<corpus::Case>& steps, const BenchSettings& settings,
                    BenchReport& report) {
  for (const auto& step : steps) compare_box_tests(step, report);
  if (!steps.empty()) compare_a_look(steps.back(), settings.rounds(15), report);
}

void measure_marking(const BenchSettings& settings, BenchReport& report) {
  for (const std::string name : {"dented-sphere", "crumpling-sphere"}) {
    constexpr int frames = 41;
    const auto scene = bench_scene(name, settings.triangles(20'000), frames);
    auto detector =
        made(Detector::create(scene.triangles, scene.frames[0], bench_options(Culling::view_point)),
             name);
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
      const auto types = types_of(result);
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
    auto detector =
        made(Detector::create(scene.triangles, scene.frames[0], bench_options(culling)), "scene");
    std::size_t free = 0;
    double looks = 0;
    for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
      const auto result = detector.step(scene.frames[f], scene.frames[f + 1]);
      if (result.counts.free_components == 0) continue;
      ++free;
      const auto& s = result.counts.search;
      looks += static_cast<double>(s.box_tests + s.child_counts + s.candidate_pairs);
    }
    report.add(fmt::format("looks at the tree in free steps, {}", name_of(culling)), "",
               exactly(looks), at_most(0),
               fmt::format("{} of {} steps free by L5", free, scene.frames.size() - 1));
  }
}

}  // namespace assay::reports
