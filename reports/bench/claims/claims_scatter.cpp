#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "corpus/scenes/scenes.h"
#include "properties/judging/case_check.h"
#include "reports/bench/bootstrap.h"
#include "reports/bench/claims/break_even.h"
#include "reports/bench/claims/claims_parts.h"
#include "reports/bench/interleave.h"
#include "reports/bench/real_sequences.h"
#include "reports/bench/same_answers.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

// The first two are those with which the others are compared.
constexpr Culling cullings[] = {Culling::bvh, Culling::normal_cone, Culling::view_point,
                                Culling::view_line, Culling::view_auto};
constexpr std::size_t yardsticks = 2;

// Makes steps as a user does, carrying the state from one to the next. Each step is evaluated
// `rounds` times by every culling in turn before it is committed.
void add_points(const std::string& name, const corpus::Sequence& scene, Start start, int rounds,
                BenchReport& report) {
  std::vector<Detector> detectors;
  for (const auto culling : cullings) {
    Options options = bench_options(culling);
    options.start = start;
    auto made = Detector::create(scene.triangles, scene.frames[0], options);
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
      for (std::size_t y = 0; y < yardsticks && d >= yardsticks; ++y) {
        const Estimate ratio = ratio_of(samples[d], samples[y]);
        report.scatter.push_back({name, properties::name_of(cullings[d]),
                                  static_cast<double>(results[d].view_positive) / triangles,
                                  ratio.value, ratio.lo, ratio.hi,
                                  properties::name_of(cullings[y])});
      }
    }
    for (auto& detector : detectors) detector.commit();
  }
}

std::vector<ScatterPoint> points_of(const BenchReport& report, const std::string& culling,
                                    const std::string& over) {
  std::vector<ScatterPoint> points;
  for (const auto& p : report.scatter) {
    if (p.culling == culling && p.over == over) points.push_back(p);
  }
  return points;
}

// Only view-auto promises never to be slower than bvh, because it falls back to bvh.
void add_worst(const std::string& culling, const std::string& over,
               const std::vector<ScatterPoint>& points, BenchReport& report) {
  const auto worst = std::max_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  constexpr double slow = wanted::view_auto_over_bvh.bound;
  std::size_t slower = 0;
  for (const auto& p : points) slower += p.ratio > slow;
  const bool promised = culling == "view-auto" && over == "bvh";
  report.add(fmt::format("largest time over {}'s, {}", over, culling), "times",
             exactly(worst->ratio), wanted_if(promised, wanted::view_auto_over_bvh),
             fmt::format("{} of {} steps are slower than {}; worst in {} at V+ {:.1f} %", slower,
                         points.size(), slow, worst->scene, 100 * worst->share));
}

// Adds the median over the steps of each scene, which shows how the whole sequence of a user
// fares. If a scene has a single step, the median is over its rounds.
void add_medians(const std::string& culling, const std::string& over,
                 const std::vector<ScatterPoint>& points, BenchReport& report) {
  for (auto p = points.begin(); p != points.end();) {
    const auto end =
        std::find_if(p, points.end(), [&](const auto& q) { return q.scene != p->scene; });
    std::vector<double> ratios;
    std::transform(p, end, std::back_inserter(ratios), [](const auto& q) { return q.ratio; });
    const auto steps = ratios.size();
    const bool promised = over == "bvh";
    report.add(
        fmt::format("{} over {}, steps of {}", culling, over, p->scene), "times",
        steps == 1 ? Estimate{p->ratio, p->lo, p->hi, ratios} : bootstrap_median(std::move(ratios)),
        wanted_if(promised, wanted::view_auto_over_bvh),
        steps == 1 ? "1 step, over its rounds" : fmt::format("{} steps; bootstrap", steps));
    p = end;
  }
}

void add_break_even(const std::string& culling, const std::string& over,
                    const std::vector<ScatterPoint>& points, BenchReport& report) {
  const BreakEven found = break_even(points);
  if (found.by_fit) {
    report.add(fmt::format("break-even share of V+ with {}, {}, by a fit", over, culling), "%",
               exactly(100 * *found.by_fit), {},
               "line through log(ratio) over share, steps that search");
  }
  report.add(fmt::format("break-even share of V+ with {}, {}, last crossing", over, culling), "%",
             exactly(100 * found.last_crossing), {},
             fmt::format("all steps with a larger share are faster than {}'s", over));
}

}  // namespace

void measure_break_even(const BenchSettings& settings, Progress& progress, BenchReport& report) {
  for (const auto& info : corpus::scenes()) {
    const std::string name(info.name);
    progress.phase("break-even, " + name);
    constexpr int frames = 21;
    // If a mesh has holes, it depends on the places of the apexes whether a start is clean. So it
    // is verified.
    const Start start = info.closed ? Start::clean : Start::verified;
    add_points(name, bench_scene(name, settings.triangles(5'120), frames), start,
               settings.rounds(5), report);
  }
  std::vector<std::string> missing;
  for (const auto& real : real_sequences(settings, missing)) {
    progress.phase("break-even, " + real.name);
    const Start start = real.starts_clean ? Start::clean : Start::verified;
    add_points(real.name, real.frames, start, settings.rounds(5), report);
  }
  for (const auto& file : missing) report.add_no_data("break-even, real sequences", file);
  for (const std::string over : {"bvh", "normal-cone"}) {
    for (const std::string culling : {"view-point", "view-line", "view-auto"}) {
      const auto points = points_of(report, culling, over);
      add_worst(culling, over, points, report);
      // A step of view-auto that fell back to bvh has no share.
      if (culling != "view-auto") {
        add_break_even(culling, over, points, report);
      } else {
        add_medians(culling, over, points, report);
      }
    }
  }
}

}  // namespace assay::reports
