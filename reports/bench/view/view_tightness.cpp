#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "corpus/scenes/scenes.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/case_options.h"
#include "properties/random.h"
#include "reports/bench/timed_step.h"
#include "reports/bench/view/view_parts.h"

namespace assay::reports {
namespace {

using namespace detector;

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
  auto made = Detector::create(scene.triangles, scene.frames[0], bench_options(culling));
  if (!made) throw UnusableData(made.error().message);
  std::vector<Shares> out;
  for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
    out.push_back(shares_of(made.value().evaluate(scene.frames[f], scene.frames[f + 1]).signs));
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
      report.add(fmt::format("V+ or V- on scene {}, {}", name, properties::name_of(culling)), "%",
                 exactly(100 * sum / static_cast<double>(steps.size())),
                 wanted_if(culling == Culling::view_line, wanted::tube_settled_from_a_line_percent),
                 fmt::format("mean of {} steps, least {:.1f} %", steps.size(), 100 * least));
    }
  }
}

void bunny(const BenchSettings& settings, BenchReport& report) {
  const std::string file = settings.file("ipc-toolkit/bunny.ply");
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    report.add_no_data("V+ of the bunny", file);
    return;
  }
  auto mesh = corpus::read_mesh(file);
  if (!mesh) throw UnusableData(mesh.error().message);
  const corpus::Sequence rest{mesh.value().triangles,
                              {mesh.value().positions, mesh.value().positions}};
  auto bent = corpus::make_scene("bend", {0, 6, std::move(mesh.value())});
  if (!bent) throw UnusableData(bent.error().message);
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    const char* name = properties::name_of(culling);
    const Wanted bound = culling == Culling::view_line
                             ? wanted::bunny_positive_from_a_line_percent
                             : wanted::bunny_positive_from_a_point_percent;
    report.add(fmt::format("V+ of the bunny at rest, {}", name), "%",
               exactly(100 * shares_over(rest, culling)[0].positive_share()), bound);
    std::vector<double> shares;
    for (const auto& step : shares_over(bent.value(), culling)) {
      shares.push_back(100 * step.positive_share());
    }
    const double last = shares.back();
    report.add(fmt::format("V+ of the bunny bent, {}", name), "%", median_of(std::move(shares)),
               bound, fmt::format("5 steps, the last {:.1f} %", last));
  }
}

}  // namespace

void measure_tightness(const BenchSettings& settings, BenchReport& report) {
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    Beyond beyond;
    const char* culling_name = properties::name_of(culling);
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

}  // namespace assay::reports
