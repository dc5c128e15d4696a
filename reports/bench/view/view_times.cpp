#include <fmt/format.h>

#include "detector/view/view_lanes.h"
#include "properties/numbering.h"
#include "properties/words.h"
#include "reports/bench/interleave.h"
#include "reports/bench/timed_step.h"
#include "reports/bench/view/plain_pass.h"
#include "reports/bench/view/swept_boxes.h"
#include "reports/bench/view/view_parts.h"

namespace assay::reports {
namespace {

using namespace detector;

struct ViewStep {
  Topology mesh;
  Positions x_t0, x_t1;
  std::vector<ViewPrimitive> primitives;  // by component, as the detector placed them
};

ViewStep view_step(const corpus::Sequence& sequence, std::size_t step, Culling culling,
                   BenchReport& report) {
  const std::span frames(&sequence.frames[step], 2);
  TimedStep detector("view step", sequence.triangles, frames, bench_options(culling), report);
  return {make_topology(sequence.triangles, frames[0].rows()), frames[0], frames[1],
          detector.result().primitives};
}

// The same mesh with its vertices in random order, so that each triangle reads three places that
// are far apart.
corpus::Sequence shuffled(const corpus::Sequence& in) {
  properties::Random random(20111, 0);
  const auto to = properties::shuffled(
      random, properties::in_order(static_cast<std::size_t>(in.frames[0].rows())));
  corpus::Sequence out = in;
  for (auto& v : out.triangles.reshaped()) v = to[static_cast<std::size_t>(v)];
  for (std::size_t f = 0; f < in.frames.size(); ++f) {
    for (Eigen::Index v = 0; v < in.frames[f].rows(); ++v) {
      out.frames[f].row(to[static_cast<std::size_t>(v)]) = in.frames[f].row(v);
    }
  }
  return out;
}

const char* name_of(InstructionSet set) {
  return properties::word_of({"baseline", "avx2", "avx512"}, set);
}

// `bound` is asked of the instruction set that this machine chooses.
void compare(const std::string& label, const ViewStep& step, Wanted bound, int rounds,
             BenchReport& report) {
  std::vector<SweptBox> boxes(step.mesh.triangles.size());
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (is_available(set)) sets.push_back(set);
  }
  std::vector<std::vector<ViewSign>> signs(sets.size(),
                                           std::vector<ViewSign>(step.mesh.triangles.size()));
  std::vector<Measurement> measurements = {[&] {
    const double ns = ns_of([&] { write_swept_boxes(step.mesh, step.x_t0, step.x_t1, boxes); });
    keep(boxes);
    return ns;
  }};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    measurements.push_back([&, i] {
      ViewCounts counts;
      return ns_of([&] {
        for (std::size_t c = 0; c < step.mesh.components.size(); ++c) {
          classify(step.mesh, step.mesh.components[c], {step.x_t0, step.x_t1}, step.primitives[c],
                   signs[i], counts, sets[i]);
        }
      });
    });
  }
  const auto samples = interleave(rounds, measurements);
  const double a_triangle = 1 / static_cast<double>(boxes.size());
  report.add("writing swept boxes, " + label, "ns/triangle",
             scaled(median_of(samples[0]), a_triangle), {},
             fmt::format("{} triangles", boxes.size()));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const bool chosen = sets[i] == best_instruction_set();
    report.add(fmt::format("view test over boxes, {}, {}", label, name_of(sets[i])), "times",
               ratio_of(samples[i + 1], samples[0]), wanted_if(chosen, bound),
               fmt::format("{:.2f} ns a triangle{}", median_of(samples[i + 1]).value * a_triangle,
                           chosen ? "; chosen here" : ""));
    if (signs[i] != signs[0]) {
      report.wrong_answers.push_back(fmt::format(
          "{}: signs of {} differ from those of the baseline", label, name_of(sets[i])));
    }
  }
}

void add_whole_step(const std::string& label, const std::vector<double>& samples,
                    const StepResult& result, bool full_size, BenchReport& report) {
  report.add("free step, " + label, "ms", scaled(median_of(samples), 1e-6),
             wanted_if(full_size, wanted::free_step_ms),
             fmt::format("{} triangles, {}", result.signs.size(),
                         result.counts.free_components == 1 ? "free by L5" : "NOT free by L5"));
}

}  // namespace

void time_view_test(const BenchSettings& settings, BenchReport& report) {
  const int triangles = settings.triangles(wanted::free_step_triangles),
            rounds = settings.rounds(21);
  const auto sphere = bench_scene("breathing-sphere", triangles, 11);
  compare("point, sphere", view_step(sphere, 1, Culling::view_point, report),
          wanted::view_test_of_a_point_over_boxes, rounds, report);
  compare("point, sphere shuffled", view_step(shuffled(sphere), 1, Culling::view_point, report),
          wanted::view_test_of_a_point_over_boxes, rounds, report);
  const auto tube = bench_scene("bend", triangles, 21);
  compare("line, bent tube", view_step(tube, 5, Culling::view_line, report),
          wanted::view_test_of_a_line_over_boxes, rounds, report);
  const auto twisted = bench_scene("twist", triangles, 21);
  compare("line, twisted tube", view_step(twisted, 5, Culling::view_line, report),
          wanted::view_test_of_a_line_over_boxes, rounds, report);
}

void time_free_steps(const BenchSettings& settings, BenchReport& report) {
  const int triangles = settings.triangles(wanted::free_step_triangles);
  const auto sphere = bench_scene("breathing-sphere", triangles, 11);
  const std::span frames(sphere.frames.data(), 3);  // the first step is committed, the next timed
  TimedStep point("view-point, breathing sphere", sphere.triangles, frames,
                  bench_options(Culling::view_point), report);
  TimedStep line("view-line, breathing sphere", sphere.triangles, frames,
                 bench_options(Culling::view_line), report);
  TimedStep bvh("bvh, breathing sphere", sphere.triangles, frames, bench_options(Culling::bvh),
                report);
  const Topology mesh = make_topology(sphere.triangles, frames[1].rows());
  const Workers alone;
  const auto samples = interleave(
      settings.rounds(15),
      {[&] { return point.time(); }, [&] { return line.time(); }, [&] { return bvh.time(); },
       [&] { return ns_of([&] { keep(read_plainly(mesh, frames[1], frames[2], alone)); }); }});
  report.add("free step over bvh's, view-point", "times", ratio_of(samples[0], samples[2]),
             wanted::free_step_over_bvh);
  report.add("free step over bvh's, view-line", "times", ratio_of(samples[1], samples[2]),
             wanted::free_step_over_bvh);
  report.add("free step over a plain pass, view-point", "times", ratio_of(samples[0], samples[3]),
             wanted::free_step_over_plain_pass,
             "a pass that reads the same positions and triangles");
  add_whole_step("view-point", samples[0], point.result(), triangles == wanted::free_step_triangles,
                 report);
  add_whole_step("view-line", samples[1], line.result(), false, report);
  report.add("the same step, bvh", "ms", scaled(median_of(samples[2]), 1e-6), {});
}

}  // namespace assay::reports
