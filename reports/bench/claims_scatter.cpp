#include <fmt/format.h>

#include <algorithm>

#include "properties/case_check.h"
#include "reports/bench/break_even.h"
#include "reports/bench/claims_parts.h"
#include "reports/bench/interleave.h"
#include "reports/bench/same_answers.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

constexpr Culling cullings[] = {Culling::bvh, Culling::view_point, Culling::view_line,
                                Culling::view_auto};

// Steps as a user makes them, state carried from one to the next, each evaluated `rounds` times by
// every culling in turn before it is committed.
void add_points(const std::string& name, const corpus::Sequence& scene, int rounds,
                BenchReport& report) {
  std::vector<Detector> detectors;
  for (const auto culling : cullings) {
    auto made = Detector::create(scene.triangles, scene.frames[0], bench_options(culling));
    if (!made) throw UnusableData(name + ": " + made.error().message);
    detectors.push_back(std::move(made.value()));
  }
  const auto triangles = static_cast<double>(scene.triangles.rows());
  for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
    std::vector<StepResult> results(detectors.size());
    std::vector<std::uint64_t> hashes(detectors.size());
    std::vector<Measurement> measurements;
    for (std::size_t d = 0; d < detectors.size(); ++d) {
      measurements.push_back([&, d] {
        const double ns = ns_of(
            [&] { results[d] = detectors[d].evaluate(scene.frames[f], scene.frames[f + 1]); });
        const auto hash = result_hash(results[d]);
        if (hashes[d] != 0 && hash != hashes[d]) {
          report.wrong_answers.push_back(name + ": two evaluations of one step differ");
        }
        hashes[d] = hash;
        return ns;
      });
    }
    const auto samples = interleave(rounds, measurements);
    for (std::size_t d = 1; d < detectors.size(); ++d) {
      check_same_pairs(fmt::format("{} step {}", name, f), results[d], results[0], report);
      report.scatter.push_back({name, properties::name_of(cullings[d]),
                                static_cast<double>(results[d].view_positive) / triangles,
                                ratio_of(samples[d], samples[0]).value});
    }
    for (auto& detector : detectors) detector.commit();
  }
}

// Only view-auto promises never to be slower: it falls back to bvh.
void add_worst(const std::string& culling, const std::vector<ScatterPoint>& points,
               BenchReport& report) {
  const auto worst = std::max_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  std::size_t slower = 0;
  for (const auto& p : points) slower += p.ratio > 1.05;
  report.add(fmt::format("largest time over bvh's, {}", culling), "times", exactly(worst->ratio),
             culling == "view-auto" ? std::optional(at_most(1.05)) : std::nullopt,
             fmt::format("{} of {} steps are slower than that; worst in {} at V+ {:.1f} %", slower,
                         points.size(), worst->scene, 100 * worst->share));
}

void add_break_even(const std::string& culling, const std::vector<ScatterPoint>& points,
                    BenchReport& report) {
  const BreakEven found = break_even(points);
  if (found.by_fit) {
    report.add(fmt::format("break-even share of V+, {}, by a fit", culling), "%",
               exactly(100 * *found.by_fit), {},
               "line through log(ratio) over share, steps that search");
  }
  report.add(fmt::format("break-even share of V+, {}, last crossing", culling), "%",
             exactly(100 * found.last_crossing), {},
             "all steps with a larger share are faster than bvh's");
}

}  // namespace

void measure_break_even(const NamedStep* rod_twist, const BenchSettings& settings,
                        Progress& progress, BenchReport& report) {
  for (const std::string name :
       {"breathing-sphere", "dented-sphere", "crumpling-sphere", "bend", "twist"}) {
    progress.phase("break-even, " + name);
    constexpr int frames = 21;
    add_points(name, bench_scene(name, settings.triangles(5'120), frames), settings.rounds(5),
               report);
  }
  if (rod_twist) add_points(rod_twist->name, rod_twist->step, settings.rounds(5), report);
  for (const std::string culling : {"view-point", "view-line", "view-auto"}) {
    std::vector<ScatterPoint> points;
    for (const auto& p : report.scatter) {
      if (p.culling == culling) points.push_back(p);
    }
    add_worst(culling, points, report);
    // A step that fell back has no share.
    if (culling != "view-auto") add_break_even(culling, points, report);
  }
}

}  // namespace assay::reports
