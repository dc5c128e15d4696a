// The view test beside the writing of swept boxes from the same arrays, in one run, interleaved,
// and free steps of a whole detector:
//   build/release/view_bench [triangles [steps]]      (steps: the free steps alone, many rounds)
// Medians of processor time, in ns a triangle or in ms.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>

#include "corpus/scenes.h"
#include "detector/detector.h"

namespace assay::detector {
namespace {

struct Shape {
  Triangles triangles;
  Positions x_t0, x_t1;
};

// Along z, `rings` rings of `around` vertices; radius(z) and the two ends closed by one vertex
// each.
template <class Radius>
Shape lathe(int rings, int around, double lo, double hi, Radius radius) {
  Shape shape;
  const int vertices = rings * around + 2;
  shape.x_t0.resize(vertices, 3);
  shape.triangles.resize(2 * rings * around, 3);
  for (int r = 0; r < rings; ++r) {
    const double z = lo + (hi - lo) * (r + 1) / (rings + 1);
    for (int a = 0; a < around; ++a) {
      const double turn = 2 * M_PI * a / around;
      shape.x_t0.row(r * around + a) << radius(z) * std::cos(turn), radius(z) * std::sin(turn), z;
    }
  }
  shape.x_t0.row(vertices - 2) << 0, 0, lo;
  shape.x_t0.row(vertices - 1) << 0, 0, hi;
  Eigen::Index t = 0;
  for (int a = 0; a < around; ++a) {
    const int b = (a + 1) % around, top = (rings - 1) * around;
    shape.triangles.row(t++) << vertices - 2, b, a;
    for (int r = 0; r + 1 < rings; ++r) {
      const int i = r * around;
      shape.triangles.row(t++) << i + a, i + b, i + around + b;
      shape.triangles.row(t++) << i + a, i + around + b, i + around + a;
    }
    shape.triangles.row(t++) << vertices - 1, top + a, top + b;
  }
  return shape;
}

// Generic motion: every vertex its own way, small against the triangles.
void move(Shape& shape, double size) {
  std::mt19937_64 engine(20111);
  std::uniform_real_distribution<double> noise(-size, size);
  shape.x_t1 = 1.01 * shape.x_t0;
  for (double& c : shape.x_t1.reshaped()) c += noise(engine);
}

Shape shuffled(const Shape& shape) {
  std::mt19937_64 engine(20112);
  std::vector<int> to(static_cast<std::size_t>(shape.x_t0.rows()));
  std::iota(to.begin(), to.end(), 0);
  std::shuffle(to.begin(), to.end(), engine);
  Shape out = shape;
  for (Eigen::Index v = 0; v < shape.x_t0.rows(); ++v) {
    out.x_t0.row(to[static_cast<std::size_t>(v)]) = shape.x_t0.row(v);
    out.x_t1.row(to[static_cast<std::size_t>(v)]) = shape.x_t1.row(v);
  }
  for (auto& v : out.triangles.reshaped()) v = to[static_cast<std::size_t>(v)];
  return out;
}

void write_boxes(const Topology& mesh, const PositionsView& x_t0, const PositionsView& x_t1,
                 std::vector<std::array<double, 6>>& boxes) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double a0 = x_t0(v[0], k), b0 = x_t0(v[1], k), c0 = x_t0(v[2], k);
      const double a1 = x_t1(v[0], k), b1 = x_t1(v[1], k), c1 = x_t1(v[2], k);
      boxes[t][static_cast<std::size_t>(k)] =
          std::min(std::min(std::min(a0, b0), std::min(c0, a1)), std::min(b1, c1));
      boxes[t][static_cast<std::size_t>(k) + 3] =
          std::max(std::max(std::max(a0, b0), std::max(c0, a1)), std::max(b1, c1));
    }
  }
}

double processor_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

void run(const char* name, const Shape& shape, const ViewPrimitive& primitive, double wanted) {
  const Topology mesh = make_topology(shape.triangles, shape.x_t0.rows());
  std::vector<std::array<double, 6>> boxes(mesh.triangles.size());
  std::vector<ViewSign> signs(mesh.triangles.size());
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (is_available(set)) sets.push_back(set);
  }
  std::vector<double> box_times;
  std::vector<std::vector<double>> times(sets.size());
  ViewCounts counts;
  for (int round = 0; round < 31; ++round) {
    double begin = processor_ns();
    write_boxes(mesh, shape.x_t0, shape.x_t1, boxes);
    box_times.push_back(processor_ns() - begin);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      counts = {};
      begin = processor_ns();
      for (const auto& component : mesh.components) {
        classify(mesh, component, shape.x_t0, shape.x_t1, primitive, signs, counts, sets[i]);
      }
      times[i].push_back(processor_ns() - begin);
    }
  }
  const auto m = static_cast<double>(mesh.triangles.size());
  const double box = median(box_times) / m;
  std::size_t positive = 0;
  for (const auto s : signs) positive += s == ViewSign::positive;
  std::printf("%-28s %8.0f triangles, V+ %.4f, lanes %.4f, exact %llu; boxes %5.2f ns\n", name, m,
              static_cast<double>(positive) / m, static_cast<double>(counts.lanes) / m,
              static_cast<unsigned long long>(counts.exact), box);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const double ns = median(times[i]) / m;
    std::printf("    %d lanes %6.2f ns  %5.2f times the boxes, wanted <= %.1f\n",
                2 << static_cast<int>(sets[i]), ns, ns / box, wanted);
  }
}

// Steps of the breathing sphere, after the first. What is not view test: checks of the input,
// comparison and copy of positions, counting of sets.
void run_free_steps(int triangles, Culling culling, int rounds) {
  auto scene = corpus::make_scene("breathing-sphere", {triangles, 11, {}});
  const auto& [mesh, frames] = scene.value();
  auto detector = Detector::create(mesh, frames[0], {culling, Start::verified, Pairs::all});
  std::vector<double> times, view_times, wall_times;
  std::size_t free = 0, steps = 0;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t f = 0; f + 1 < frames.size(); ++f, ++steps) {
      const double begin = processor_ns();
      const StepResult result = detector.value().step(frames[f], frames[f + 1]);
      if (steps > 0) times.push_back(1e-6 * (processor_ns() - begin));
      if (steps > 0) view_times.push_back(result.times.view_test);
      if (steps > 0) wall_times.push_back(result.times.total);
      free += result.answer == Answer::free && result.counts.free_components == 1;
    }
    detector.value().reset();
  }
  std::printf(
      "free steps, %s, %d triangles: %zu of %zu free; %.2f ms a step (wall clock %.2f, of it "
      "view test %.2f), wanted <= 10\n",
      culling == Culling::view_point ? "point" : "line", static_cast<int>(mesh.rows()), free, steps,
      median(times), median(wall_times), median(view_times));
}

void run_all(int triangles) {
  const int around = std::max(3, static_cast<int>(std::sqrt(triangles / 2.0)));
  Shape sphere = lathe(around, around, -1, 1, [](double z) { return std::sqrt(1 - z * z); });
  move(sphere, 1e-6);
  const MovingPoint centre = {{.01, .02, .03}, {.011, .019, .031}};
  run("point, sphere, natural", sphere, {centre, centre}, 2.5);
  run("point, sphere, shuffled", shuffled(sphere), {centre, centre}, 2.5);
  // A tube with a waist, wider towards its ends: a point sees a part of it from behind.
  Shape tube = lathe(2 * around, around / 2, -6, 6, [](double z) {
    return (.5 + .1 * std::cos(2 * z)) * std::sqrt(1 - z * z / 36.01);
  });
  move(tube, 1e-6);
  const ViewPrimitive line = {{{.01, 0, -5.5}, {.012, 0, -5.4}}, {{0, .01, 5.5}, {0, .008, 5.6}}};
  run("line, tube, natural", tube, line, 3);
  run("line, tube, shuffled", shuffled(tube), line, 3);
  run("line, sphere, natural", sphere, {{{0, 0, -.3}, {0, .01, -.31}}, {{0, 0, .3}, {0, 0, .29}}},
      3);
}

}  // namespace
}  // namespace assay::detector

int main(int argc, char** argv) {
  using namespace assay::detector;
  const int triangles = argc > 1 ? std::atoi(argv[1]) : 327'680;
  const bool steps_alone = argc > 2;
  if (!steps_alone) run_all(triangles);
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    run_free_steps(triangles, culling, steps_alone ? 40 : 5);
  }
}
