// Suite `view` measures what the view test and a free step take, and how tight the view sets are.
#include <fmt/format.h>

#include <algorithm>

#include "detector/view/view_lanes.h"
#include "oracle/view/view_sign.h"
#include "properties/numbering.h"
#include "properties/random.h"
#include "properties/words.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/parts/measuring_arena.h"
#include "reports/bench/sweep.h"

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

// Times the view test over the writing of swept boxes from the same arrays, for each instruction
// set that this machine has. Signs that differ between the sets are wrong answers.
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

// Times steps that are all positive: over culling bvh on the same step, and by themselves.
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

struct Shares {
  std::size_t triangles = 0, positive = 0, negative = 0;
  double positive_share() const { return share(positive); }
  double settled_share() const { return share(positive + negative); }

 private:
  double share(std::size_t part) const {
    return static_cast<double>(part) / static_cast<double>(triangles);
  }
};

Shares shares_of(const std::vector<ViewSign>& signs) {
  Shares shares{signs.size()};
  for (const auto sign : signs) {
    shares.positive += sign == ViewSign::positive;
    shares.negative += sign == ViewSign::negative;
  }
  return shares;
}

// The shares in all steps of a scene, seen from the primitives that the detector itself placed at
// the first frame.
std::vector<Shares> shares_over(const corpus::Sequence& scene, Culling culling) {
  auto detector =
      made(Detector::create(scene.triangles, scene.frames[0], bench_options(culling)), "scene");
  std::vector<Shares> out;
  for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
    out.push_back(shares_of(detector.evaluate(scene.frames[f], scene.frames[f + 1]).signs));
  }
  return out;
}

// Moves every coordinate a little on its own, so that nothing is degenerate.
corpus::Sequence generic(corpus::Sequence scene) {
  properties::Random random(20112, 0);
  for (auto& frame : scene.frames) {
    const double size = 1e-4 * (frame.colwise().maxCoeff() - frame.colwise().minCoeff()).norm();
    for (double& c : frame.reshaped()) c += size * random.signed_unit();
  }
  return scene;
}

struct Beyond {
  // `exact` and `bounded` count the triangles in V0 that the oracle does not have there.
  std::size_t triangles = 0, exact = 0, bounded = 0;
};

void compare_with_oracle(const std::string& name, const corpus::Sequence& scene, std::size_t step,
                         Culling culling, Beyond& beyond, BenchReport& report) {
  const std::span frames(&scene.frames[step], 2);
  TimedStep exact(name, scene.triangles, frames, bench_options(culling), report);
  TimedStep bounded(name, scene.triangles, frames, bench_options(culling, Arithmetic::bounded),
                    report);
  const auto& by_exact = exact.result();
  const auto& by_bounded = bounded.result();
  const Topology mesh = make_topology(scene.triangles, frames[0].rows());
  std::vector<ViewPrimitive> of_triangle;
  for (const auto c : mesh.component_of_triangle) {
    of_triangle.push_back(by_exact.primitives[static_cast<std::size_t>(c)]);
  }
  const auto truth = oracle::view_signs({frames[0], frames[1]}, scene.triangles, of_triangle, 1);
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    wrong += by_exact.signs[t] != ViewSign::zero && by_exact.signs[t] != truth[t];
    wrong += by_bounded.signs[t] != ViewSign::zero && by_bounded.signs[t] != truth[t];
    const bool settled = truth[t] != ViewSign::zero;
    beyond.exact += settled && by_exact.signs[t] == ViewSign::zero;
    beyond.bounded += settled && by_bounded.signs[t] == ViewSign::zero;
  }
  beyond.triangles += truth.size();
  if (wrong > 0) {
    report.wrong_answers.push_back(
        fmt::format("{}: {} view signs are not those of the oracle", name, wrong));
  }
}

void settled_on_tubes(const BenchSettings& settings, BenchReport& report) {
  for (const std::string name : {"bend", "twist"}) {
    const auto tube = bench_scene(name, settings.triangles(5'120), 21);
    for (const auto culling : {Culling::view_line, Culling::view_point}) {
      double sum = 0, least = 1;
      const auto steps = shares_over(tube, culling);
      for (const auto& step : steps) {
        sum += step.settled_share();
        least = std::min(least, step.settled_share());
      }
      report.add(fmt::format("V+ or V- on scene {}, {}", name, name_of(culling)), "%",
                 exactly(100 * sum / static_cast<double>(steps.size())),
                 wanted_if(culling == Culling::view_line, wanted::tube_settled_from_a_line_percent),
                 fmt::format("mean of {} steps, least {:.1f} %", steps.size(), 100 * least));
    }
  }
}

void bunny(const BenchSettings& settings, BenchReport& report) {
  const auto mesh = bunny_at_rest(settings);
  if (!mesh) {
    report.add_no_data("V+ of the bunny", bunny_file(settings));
    return;
  }
  const corpus::Sequence rest{mesh->triangles, {mesh->positions, mesh->positions}};
  const auto bent = bent_bunny(settings);
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    const char* name = name_of(culling);
    const Wanted bound = culling == Culling::view_line
                             ? wanted::bunny_positive_from_a_line_percent
                             : wanted::bunny_positive_from_a_point_percent;
    report.add(fmt::format("V+ of the bunny at rest, {}", name), "%",
               exactly(100 * shares_over(rest, culling)[0].positive_share()), bound);
    std::vector<double> shares;
    for (const auto& step : shares_over(*bent, culling)) {
      shares.push_back(100 * step.positive_share());
    }
    const double last = shares.back();
    report.add(fmt::format("V+ of the bunny bent, {}", name), "%", median_of(std::move(shares)),
               bound, fmt::format("5 steps, the last {:.1f} %", last));
  }
}

// Measures V0 beyond the exact V0, and the shares of V+ and V-. A sign that is not the oracle's is
// a wrong answer.
void measure_tightness(const BenchSettings& settings, BenchReport& report) {
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    Beyond beyond;
    const char* culling_name = name_of(culling);
    for (const std::string name :
         {"breathing-sphere", "dented-sphere", "crumpling-sphere", "bend", "twist"}) {
      const auto scene = generic(bench_scene(name, settings.triangles(2'560), 11));
      for (const std::size_t step : {1u, 4u}) {
        compare_with_oracle(fmt::format("{} step {}, {}", name, step, culling_name), scene, step,
                            culling, beyond, report);
      }
    }
    const auto add = [&](const char* arithmetic, std::size_t count, Wanted bound) {
      report.add(fmt::format("V0 beyond the exact V0, {}, {}", culling_name, arithmetic), "%",
                 exactly(100 * static_cast<double>(count) / static_cast<double>(beyond.triangles)),
                 bound,
                 fmt::format("{} of {} triangles of generic meshes", count, beyond.triangles));
    };
    add("bounded", beyond.bounded, wanted::zero_beyond_exact_in_bounded_percent);
    add("exact", beyond.exact, at_most(0));
  }
  settled_on_tubes(settings, report);
  bunny(settings, report);
}

}  // namespace

BenchReport view_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("view");
  progress.phase("view test against swept boxes");
  time_view_test(settings, report);
  progress.phase("free steps");
  time_free_steps(settings, report);
  progress.phase("view sets against the oracle's");
  measure_tightness(settings, report);
  return report;
}

}  // namespace assay::reports
