#include <fmt/format.h>

#include "reports/bench/claims/claims_parts.h"
#include "reports/bench/interleave.h"
#include "reports/bench/same_answers.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

void compare(const NamedStep& named, bool is_rod_twist, int rounds, BenchReport& report) {
  const auto& [name, step] = named;
  const auto timed = [&, &triangles = step.triangles, &frames = step.frames](
                         Culling culling, Arithmetic arithmetic) {
    return TimedStep(named.name, triangles, frames, bench_options(culling, arithmetic), report);
  };
  TimedStep bvh = timed(Culling::bvh, Arithmetic::exact);
  TimedStep point = timed(Culling::view_point, Arithmetic::exact);
  TimedStep line = timed(Culling::view_line, Arithmetic::exact);
  TimedStep chosen = timed(Culling::view_auto, Arithmetic::exact);
  TimedStep in_doubles = timed(Culling::view_point, Arithmetic::double_precision);
  std::vector<double> broad_phase_ns;
  const auto time_bvh = [&] {
    const double ns = bvh.time();
    broad_phase_ns.push_back(1e6 * bvh.result().times.broad_phase);
    return ns;
  };
  const auto samples =
      interleave(rounds, {time_bvh, [&] { return point.time(); }, [&] { return line.time(); },
                          [&] { return chosen.time(); }, [&] { return in_doubles.time(); }});
  const auto only_rods = [&](Wanted bound) { return wanted_if(is_rod_twist, bound); };
  report.add(fmt::format("whole step, {}, bvh", name), "s", scaled(median_of(samples[0]), 1e-9),
             only_rods(wanted::rod_twist_bvh_step_s),
             fmt::format("{} pairs", bvh.result().pairs.size()));
  report.add(fmt::format("broad phase, {}, bvh", name), "s",
             scaled(median_of(broad_phase_ns), 1e-9),
             only_rods(wanted::rod_twist_bvh_broad_phase_s), "of the same steps");
  const auto with_views = [&](TimedStep& views, const std::vector<double>& times,
                              const char* culling) {
    report.add(
        fmt::format("whole step, {}, {}", name, culling), "s", scaled(median_of(times), 1e-9),
        only_rods(wanted::rod_twist_step_s),
        fmt::format("all pairs, exact, clean start; V+ {:.1f} %", 100 * views.positive_share()));
    const auto of_views = views.result().counts.search.candidate_pairs,
               of_bvh = bvh.result().counts.search.candidate_pairs;
    report.add(fmt::format("K and closure: candidates over bvh's, {}, {}", name, culling), "times",
               exactly(static_cast<double>(of_views) / static_cast<double>(of_bvh)),
               only_rods(wanted::rod_twist_candidates_over_bvh),
               fmt::format("{} over {}", of_views, of_bvh));
    report.add(fmt::format("K and closure: time over bvh's, {}, {}", name, culling), "times",
               ratio_of(times, samples[0]), only_rods(wanted::rod_twist_step_over_bvh));
    check_same_pairs(name, views.result(), bvh.result(), report);
  };
  with_views(point, samples[1], "view-point");
  with_views(line, samples[2], "view-line");
  with_views(chosen, samples[3], "view-auto");
  report.add(fmt::format("exact over double, whole step, {}", name), "times",
             ratio_of(samples[1], samples[4]), wanted::exact_over_double,
             fmt::format("view-point; integers decide {} of {} tests",
                         point.result().counts.narrow.rungs.by_integers(),
                         point.result().counts.narrow.elementary_tests));
}

}  // namespace

void time_whole_steps(const std::vector<NamedStep>& steps, bool has_rod_twist,
                      const BenchSettings& settings, BenchReport& report) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is_rod_twist = has_rod_twist && i + 1 == steps.size();
    compare(steps[i], is_rod_twist, settings.rounds(is_rod_twist ? 7 : 11), report);
  }
}

}  // namespace assay::reports
