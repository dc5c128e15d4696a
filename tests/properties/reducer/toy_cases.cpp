#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "corpus/scenes/shapes.h"
#include "detector/options.h"
#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "tests/curated_cases.h"
#include "tests/meshes.h"
#include "tests/properties/reducer/toy_faults.h"

namespace assay::properties::toys {
namespace {

using corpus::Case, detector::Positions;

double unit_of(Random& random) { return random.between(-100000, 100000) / 100000.; }

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
      if (random_.below(25) == 0)
        for (int k = 0; k < 3; ++k) moved(v, k) += strength * unit();
    }
    return moved;
  }

 private:
  struct Wave {
    Eigen::Vector3d direction, amplitude;
    double phase = 0;
  };
  double unit() { return unit_of(random_); }

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

class Inflation {
 public:
  Inflation(const Judge& judge, std::uint64_t seed) : judge_(judge), random_(seed, 7) {}

  Case run(Case c, int triangles, int steps) {
    const auto found = judge_(c);
    if (!found) throw std::runtime_error(c.id + " holds");
    signature_ = found->signature;
    Case closed = c;
    closed.ghosts.reset();
    keep_if_it_fails(c, closed);
    // Many splits at once while that goes well.
    for (int tries = 0, at_once = 16; tries < 8 * triangles; ++tries) {
      const int wanted = (triangles - static_cast<int>(c.triangles.rows())) / 2;
      if (wanted <= 0) break;
      Case larger = c;
      for (int n = std::min(at_once, wanted); n > 0; --n) larger = split(larger);
      at_once = keep_if_it_fails(c, larger) ? 2 * at_once : std::max(1, at_once / 2);
    }
    keep_if_it_fails(c, noisy(c));
    while (static_cast<int>(c.frames.size()) <= steps && c.script.empty() && !c.ghosts) {
      Case longer = c;
      add_frame(longer, random_.below(3) > 0);
      if (keep_if_it_fails(c, longer)) continue;
      Case still = c;
      insert(still, c.frames.front(), true);
      if (!keep_if_it_fails(c, still)) break;
    }
    return c;
  }

 private:
  double unit() { return unit_of(random_); }

  bool keep_if_it_fails(Case& c, const Case& changed) {
    if (!is_valid(changed)) return false;
    const auto found = judge_(changed);
    if (!found || found->signature != signature_) return false;
    c = changed;
    return true;
  }

  // A vertex in a face, or on an edge that two triangles share; not far from where it was flat.
  Case split(const Case& c) {
    auto mesh = triangles_of(c);
    const auto t = static_cast<std::size_t>(random_.below(static_cast<int>(mesh.size())));
    const auto corners = mesh[t];
    const auto added = static_cast<std::int32_t>(c.frames.front().rows());
    const bool on_edge = random_.below(3) > 0;
    Case result = c;
    for (auto& frame : result.frames) {
      frame.conservativeResize(added + 1, Eigen::NoChange);
      const Eigen::RowVector3d sum = frame.row(corners[0]) + frame.row(corners[1]);
      frame.row(added) = sum / 2;
      if (!on_edge) frame.row(added) = (sum + frame.row(corners[2])) / 3;
      for (int k = 0; k < 3; ++k) frame(added, k) += 0.01 * unit();
    }
    if (!on_edge) {
      mesh[t] = {corners[0], corners[1], added};
      mesh.push_back({corners[1], corners[2], added});
      mesh.push_back({corners[2], corners[0], added});
    } else {
      std::vector<tests::Corners> halves;
      for (const auto& old : mesh) {
        const auto at = [&](std::size_t i) { return old[i % 3]; };
        const auto is_edge = [&](std::size_t i) {
          return (at(i) == corners[0] && at(i + 1) == corners[1]) ||
                 (at(i) == corners[1] && at(i + 1) == corners[0]);
        };
        std::size_t i = 0;
        while (i < 3 && !is_edge(i)) ++i;
        halves.push_back(i == 3 ? old : tests::Corners{at(i), added, at(i + 2)});
        if (i < 3) halves.push_back({added, at(i + 1), at(i + 2)});
      }
      mesh = halves;
    }
    return with_triangles(result, mesh);
  }

  Case noisy(const Case& c) {
    Case result = c;
    for (auto& frame : result.frames)
      for (Eigen::Index i = 0; i < frame.size(); ++i) frame.data()[i] += 1e-3 * unit();
    return result;
  }

  // A little larger or smaller than the frame beside it, and moved.
  void add_frame(Case& c, bool before) {
    detector::Positions x = before ? c.frames.front() : c.frames.back();
    const Eigen::RowVector3d shift(0.2 * unit(), 0.2 * unit(), 0.2 * unit());
    x = x * (1 + 0.1 * unit());
    x.rowwise() += shift;
    insert(c, x, before);
  }

  static void insert(Case& c, const detector::Positions& x, bool before) {
    c.frames.insert(before ? c.frames.begin() : c.frames.end(), x);
    if (!c.view) return;
    c.view->q0.push_back(c.view->q0.back());
    if (!c.view->q1.empty()) c.view->q1.push_back(c.view->q1.back());
  }

  const Judge& judge_;
  Random random_;
  std::string signature_;
};

Case known_case(const ToyFault& fault) {
  auto c = tests::curated_case(fault.known);
  c.ghosts.reset();
  return c;
}

}  // namespace

Case inflated_case(const Case& small, const Judge& judge, int triangles, int steps,
                   std::uint64_t seed) {
  return Inflation(judge, seed).run(small, triangles, steps);
}

Case large_failing_case(const ToyFault& fault, int triangles, int steps, std::uint64_t seed) {
  for (std::uint64_t index = 0; index < (fault.known.empty() ? 400 : 4); ++index) {
    Random random(seed, index);
    Case c = starting_case(fault.start, triangles, random);
    Motion motion(random);
    const double strength = 0.05 * random.between(1, 8);
    // Gentle at first: most of the steps should pass before it fails.
    for (int s = 0; s < steps; ++s)
      c.frames.push_back(motion.after(c.frames.back(), strength * (s + 1) / steps));
    if (fault.start == Start::tube_with_line)
      c.view = corpus::CaseView{std::vector<detector::Point>(c.frames.size(), {0, 0, -2.5}),
                                std::vector<detector::Point>(c.frames.size(), {0, 0, 2.5})};
    if (fault.judge(c)) return c;
  }
  return inflated_case(known_case(fault), fault.judge, triangles, steps, seed);
}

}  // namespace assay::properties::toys
