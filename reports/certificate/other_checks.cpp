#include "reports/certificate/other_checks.h"

#include "properties/campaign/plan.h"
#include "properties/queries/self_check.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using detector::Arithmetic;
using detector::Culling;
using detector::Options;
using properties::SpeedFigure;

constexpr int rounds = 9;

// The time of the first options over that of the second, measured in turn.
SpeedFigure figure_of(std::string_view name, const corpus::Sequence& step, const Options& measured,
                      const Options& beside) {
  BenchReport unused;
  TimedStep one("", step.triangles, step.frames, measured, unused);
  TimedStep other("", step.triangles, step.frames, beside, unused);
  const auto samples =
      interleave(rounds, {[&] { return one.time(); }, [&] { return other.time(); }});
  const Estimate ratio = ratio_of(samples[0], samples[1]);
  return {std::string(name), ratio.value, ratio.lo, ratio.hi, ratio.samples};
}

}  // namespace

void check_oracle(std::uint64_t queries, int jobs, const OnSelfTestRow& on_family) {
  properties::SelfTestOptions options;
  options.queries = queries;
  options.jobs = jobs;
  for (const auto& family : properties::self_test_families()) {
    if (family->indices(queries) == 0) continue;
    const auto result = properties::run_family(*family, options, [](std::uint64_t) {});
    const auto& tally = result.tally;
    on_family({family->name(), tally.queries, tally.contacts, tally.contradictions, tally.open,
               result.complete});
  }
}

void measure_speed(const OnSpeedFigure& on_figure) {
  constexpr int free_triangles = 20'480, search_triangles = 4'000, frames = 3;
  const auto exact = bench_options(Culling::automatic), bvh = bench_options(Culling::bvh);
  const auto sphere = bench_scene("breathing-sphere", free_triangles, frames);
  on_figure(figure_of(properties::speed_figures[0], sphere, exact, bvh));
  // This scene is most like rod-twist, for whose step the limit is stated.
  const auto twist = bench_scene("twist", search_triangles, frames);
  on_figure(figure_of(properties::speed_figures[2], twist, exact,
                      bench_options(Culling::automatic, Arithmetic::double_precision)));
  const auto contact = step_at_first_contact("pinching-torus", search_triangles);
  if (contact) on_figure(figure_of(properties::speed_figures[1], *contact, exact, bvh));
}

}  // namespace assay::reports
