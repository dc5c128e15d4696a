#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "corpus/scenes/scenes.h"
#include "reports/bench/cases.h"
#include "reports/bench/parts/claims_parts.h"
#include "reports/bench/pictures.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

// The first two are those with which the others are compared.
constexpr Culling cullings[] = {Culling::bvh, Culling::normal_cone, Culling::view_point,
                                Culling::view_line, Culling::view_auto};
constexpr std::size_t yardsticks = 2;

// Makes steps as a user does, carrying the state from one to the next.
void add_points(const TimedCase& timed, int rounds, std::vector<ScatterPoint>& scatter,
                BenchReport& report) {
  const auto& name = timed.c.id;
  std::vector<Options> subjects;
  for (const auto culling : cullings) {
    subjects.push_back(options_of_sequence(culling, timed.start, 1));
  }
  const auto triangles = static_cast<double>(timed.c.triangles.rows());
  sweep_steps(timed.c, subjects, rounds, [&](std::size_t f, std::span<const SweptStep> swept) {
    for (std::size_t d = 0; d < swept.size(); ++d) {
      if (swept[d].differs)
        report.wrong_answers.push_back(name + ": two evaluations of one step differ");
      check_same_pairs(fmt::format("{} step {}", name, f), swept[d].result, swept[0].result,
                       report);
      for (std::size_t y = 0; y < yardsticks && d >= yardsticks; ++y) {
        const Estimate ratio = ratio_of(swept[d].ns, swept[y].ns);
        scatter.push_back({name, name_of(cullings[d]),
                           static_cast<double>(swept[d].result.view_positive) / triangles,
                           ratio.value, ratio.lo, ratio.hi, name_of(cullings[y])});
      }
    }
  });
}

std::vector<ScatterPoint> points_of(const std::vector<ScatterPoint>& scatter,
                                    const std::string& culling, const std::string& over) {
  std::vector<ScatterPoint> points;
  for (const auto& p : scatter) {
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

void measure_break_even(const BenchSettings& settings, const BenchProgress& progress,
                        BenchReport& report) {
  constexpr int frames = 21;
  std::vector<ScatterPoint> scatter;
  const auto add = [&](const std::string& name, corpus::Sequence sequence, Start start) {
    progress.phase("break-even, " + name);
    add_points(timed_case(name, std::move(sequence), start), settings.rounds(5), scatter, report);
  };
  // If a mesh has holes, it depends on the places of the apexes whether a start is clean. So it
  // is verified.
  for (const auto& info : corpus::scenes()) {
    const std::string name(info.name);
    add(name, bench_scene(name, settings.triangles(5'120), frames),
        info.closed ? Start::clean : Start::verified);
  }
  std::vector<std::string> missing;
  for (auto& real : real_sequences(settings, missing))
    add(real.name, std::move(real.frames), real.start());
  for (const auto& file : missing) report.add_no_data("break-even, real sequences", file);
  for (const std::string over : {"bvh", "normal-cone"}) {
    for (const std::string culling : {"view-point", "view-line", "view-auto"}) {
      const auto points = points_of(scatter, culling, over);
      add_worst(culling, over, points, report);
      // A step of view-auto that fell back to bvh has no share.
      if (culling != "view-auto") {
        add_break_even(culling, over, points, report);
      } else {
        add_medians(culling, over, points, report);
      }
    }
  }
  for (const auto& p : scatter) {
    report.add_figure(
        "scatter",
        json_object("scene", p.scene, "culling", p.culling, "view_positive_share", p.share, "over",
                    p.over, "time_over", p.ratio, "interval", std::array{p.lo, p.hi}));
  }
  report.picture = share_picture(scatter);
}

}  // namespace assay::reports
