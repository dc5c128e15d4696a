// Times the view test beside the writing of swept boxes, with which every method with bounding
// volumes begins; and free steps beside a plain pass over the same arrays, and beside Culling::bvh.
#include "detector/assembly.h"
#include "detector/mesh/for_all.h"
#include "detector/view/view_lanes.h"
#include "detector/view/view_signs.h"
#include "tests/bench/step_parts.h"

namespace assay::tests {
namespace {

using namespace detector;

constexpr int full_size = 327'680;

struct Scene {
  const char* name;
  int frames;
  std::size_t step;
  Culling culling;
};
constexpr Scene scenes[] = {{"breathing-sphere", 11, 1, Culling::view_point},
                            {"bend", 21, 5, Culling::view_line},
                            {"twist", 21, 5, Culling::view_line}};

void write_boxes(benchmark::State& state, const Scene& scene) {
  const auto step = bench_step(scene.name, sized(full_size), scene.frames, scene.step);
  const auto &x0 = step.frames[0], &x1 = step.frames[1];
  const auto mesh = make_topology(step.triangles, x0.rows());
  std::vector<std::array<double, 6>> boxes(mesh.triangles.size());
  for (auto _ : state) {
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      const auto& v = mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        boxes[t][k] = std::min(
            {x0(v[0], c), x0(v[1], c), x0(v[2], c), x1(v[0], c), x1(v[1], c), x1(v[2], c)});
        boxes[t][k + 3] = std::max(
            {x0(v[0], c), x0(v[1], c), x0(v[2], c), x1(v[0], c), x1(v[1], c), x1(v[2], c)});
      }
    }
    benchmark::DoNotOptimize(boxes.data());
    benchmark::ClobberMemory();
  }
  show_each(state, boxes.size());
}

void look(benchmark::State& state, const Scene& scene, InstructionSet set) {
  const auto step = bench_step(scene.name, sized(full_size), scene.frames, scene.step);
  const auto mesh = make_topology(step.triangles, step.frames[0].rows());
  const auto primitives =
      Detector::create(step.triangles, step.frames[0], bench_options(scene.culling))
          .value()
          .evaluate(step.frames[0], step.frames[1])
          .primitives;
  std::vector<ViewSign> signs(mesh.triangles.size());
  for (auto _ : state) {
    ViewCounts counts;
    for (std::size_t c = 0; c < mesh.components.size(); ++c)
      classify(mesh, mesh.components[c], {step.frames[0], step.frames[1]}, primitives[c], signs,
               counts, set);
  }
  show_each(state, signs.size());
}

corpus::Sequence sphere() { return reports::bench_scene("breathing-sphere", sized(full_size), 11); }

// The first step is committed, the next one timed.
void step_freely(benchmark::State& state, Culling culling, std::uint32_t threads) {
  const auto scene = sphere();
  auto options = bench_options(culling);
  options.threads = threads;
  auto detector = Detector::create(scene.triangles, scene.frames[0], options).value();
  detector.step(scene.frames[0], scene.frames[1]);
  StepResult result;
  for (auto _ : state) result = detector.evaluate(scene.frames[1], scene.frames[2]);
  show_each(state, static_cast<std::size_t>(scene.triangles.rows()));
  state.counters["free_by_views"] = static_cast<double>(result.counts.free_components);
}

// Does nothing but read the three corners of every triangle at both ends of the step.
void read_plainly(benchmark::State& state, std::uint32_t threads) {
  const auto scene = sphere();
  const auto &x0 = scene.frames[1], &x1 = scene.frames[2];
  const auto mesh = make_topology(scene.triangles, x0.rows());
  const Workers workers(threads);
  std::vector<double> sums(workers.count());
  for (auto _ : state) {
    workers.share_out(mesh.triangles.size(), 4096, [&](const LoopPiece& piece) {
      double sum = 0;
      for (std::size_t t = piece.begin; t < piece.end; ++t) {
        for (const auto v : mesh.triangles[t]) {
          for (Eigen::Index k = 0; k < 3; ++k) sum += x0(v, k) + x1(v, k);
        }
      }
      sums[piece.lane] += sum;
    });
    benchmark::DoNotOptimize(sums.data());
  }
  show_each(state, mesh.triangles.size());
}

const bool are_added = [] {
  for (const auto& scene : scenes) {
    add(std::string("view/swept_boxes/") + scene.name, write_boxes, scene);
    constexpr std::pair<const char*, InstructionSet> sets[] = {
        {"baseline", InstructionSet::baseline},
        {"avx2", InstructionSet::avx2},
        {"avx512", InstructionSet::avx512}};
    for (const auto& [name, set] : sets) {
      if (is_available(set))
        add(std::string("view/test/") + scene.name + "/" + name, look, scene, set);
    }
  }
  for (const std::uint32_t threads : {1u, 2u}) {
    const auto with = "/threads:" + std::to_string(threads);
    add("free_step/plain_pass" + with, read_plainly, threads)->UseRealTime();
    for (const auto culling : {Culling::view_point, Culling::view_line, Culling::bvh})
      add(std::string("free_step/") + name_of(culling) + with, step_freely, culling, threads)
          ->UseRealTime();
  }
  return true;
}();

}  // namespace
}  // namespace assay::tests
