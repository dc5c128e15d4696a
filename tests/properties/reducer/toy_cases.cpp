#include <cmath>
#include <stdexcept>

#include "corpus/scenes/shapes.h"
#include "detector/options.h"
#include "properties/random.h"
#include "tests/curated_cases.h"
#include "tests/properties/reducer/inflate.h"
#include "tests/properties/reducer/toy_faults.h"

namespace assay::properties::toys {
namespace {

using corpus::Case, detector::Positions;

// A sum of few waves, and a jump of a vertex now and then.
class Motion {
 public:
  explicit Motion(Random& random) : random_(random) {
    for (auto& wave : waves_) {
      for (int k = 0; k < 3; ++k) {
        wave.direction[k] = unit() * 3;
        wave.amplitude[k] = unit() * 0.25;
      }
      wave.phase = unit() * 3;
    }
  }
  Positions after(const Positions& x, double strength) {
    Positions moved = x;
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      for (const auto& wave : waves_) {
        const double s = std::sin(wave.direction.dot(x.row(v).transpose()) + wave.phase);
        moved.row(v) += strength * s * wave.amplitude.transpose();
      }
      if (random_.below(25) == 0) {
        for (int k = 0; k < 3; ++k) moved(v, k) += strength * unit();
      }
    }
    return moved;
  }

 private:
  struct Wave {
    Eigen::Vector3d direction, amplitude;
    double phase = 0;
  };
  double unit() { return static_cast<double>(random_.between(-100000, 100000)) / 100000; }

  Random& random_;
  std::array<Wave, 4> waves_;
};

Case starting_case(Start start, int triangles, Random& random) {
  corpus::Mesh mesh;
  Case c;
  switch (start) {
    case Start::closed: {
      const int shape = random.below(3);
      mesh = shape == 0   ? corpus::sphere_shape(triangles)
             : shape == 1 ? corpus::tube_shape(triangles, true)
                          : corpus::torus_shape(triangles);
      break;
    }
    case Start::nested_shells: {
      mesh = corpus::side_by_side(corpus::sphere_shape(triangles / 2),
                                  corpus::sphere_shape(triangles / 2), 0);
      const auto half = mesh.positions.rows() / 2;
      mesh.positions.bottomRows(half) *= 0.75;
      break;
    }
    case Start::tube_with_line:
      mesh = corpus::tube_shape(triangles, true);
      break;
    case Start::open:
      mesh = corpus::sphere_shape(triangles);
      mesh.triangles =
          corpus::sphere_shape(triangles).triangles.topRows(mesh.triangles.rows() * 3 / 4);
      break;
  }
  c.id = "large";
  c.triangles = mesh.triangles;
  c.frames = {mesh.positions};
  c.options["culling"] = start == Start::tube_with_line ? "view-line" : "view-point";
  return c;
}

Case known_case(const ToyFault& fault) {
  auto c = tests::curated_case(fault.known);
  c.ghosts.reset();
  return c;
}

}  // namespace

Case large_failing_case(const ToyFault& fault, int triangles, int steps, std::uint64_t seed) {
  for (std::uint64_t index = 0; index < (fault.known.empty() ? 400 : 4); ++index) {
    Random random(seed, index);
    Case c = starting_case(fault.start, triangles, random);
    Motion motion(random);
    const double strength = 0.05 * random.between(1, 8);
    // Gentle at first: most of the steps should pass before it fails.
    for (int s = 0; s < steps; ++s) {
      c.frames.push_back(motion.after(c.frames.back(), strength * (s + 1) / steps));
    }
    if (fault.start == Start::tube_with_line) {
      c.view = corpus::CaseView{std::vector<detector::Point>(c.frames.size(), {0, 0, -2.5}),
                                std::vector<detector::Point>(c.frames.size(), {0, 0, 2.5})};
    }
    if (fault.judge(c)) return c;
  }
  return inflated_case(known_case(fault), fault.judge, triangles, steps, seed);
}

}  // namespace assay::properties::toys
