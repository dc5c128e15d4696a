// Batches of random moving triangles seen from one primitive, in families from generic to
// degenerate, for comparing ways to find their view signs.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::tests {

enum class BatchFamily : std::uint8_t {
  generic,          // coordinates in [-1,1], large steps
  small_motion,     // moves by a triangle's size, mostly of one sign
  near_degenerate,  // small integers moved by a few units in the last place
  degenerate,       // small integers
  far,              // around 1e6
  mixed_scales,     // 2^-40 to 2^40 in one triangle
  tiny,             // denormals beside ordinary numbers
  huge,             // beyond the range of the filters
};
inline constexpr std::array<const char*, 8> batch_family_names = {
    "generic", "small motion", "near-degenerate", "degenerate", "far", "mixed scales",
    "tiny",    "huge"};

struct TriangleBatch {
  detector::Topology mesh;  // one component of all triangles, which share vertices at random
  detector::Positions x_t0, x_t1;
  detector::ViewPrimitive primitive;

  std::array<detector::MovingPoint, 3> triangle(std::size_t t) const {
    const auto& v = mesh.triangles[t];
    const detector::SteppedMesh motion = {x_t0, x_t1};
    return {motion.path(v[0]), motion.path(v[1]), motion.path(v[2])};
  }
};

class BatchMaker {
 public:
  explicit BatchMaker(std::uint64_t seed) : engine_(seed) {}

  TriangleBatch make(BatchFamily family, std::size_t triangles, bool line) {
    family_ = family;
    TriangleBatch batch;
    const auto vertices = static_cast<Eigen::Index>(triangles + 2);
    batch.x_t0.resize(vertices, 3);
    batch.x_t1.resize(vertices, 3);
    const double motion = family == BatchFamily::small_motion ? 1e-3 : 1;
    for (Eigen::Index v = 0; v < vertices; ++v) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        batch.x_t0(v, k) = number();
        // A third of the coordinates rest.
        batch.x_t1(v, k) = engine_() % 3 == 0 ? batch.x_t0(v, k)
                           : motion < 1       ? batch.x_t0(v, k) + motion * number()
                                              : number();
      }
    }
    batch.mesh.components.resize(1);
    auto& component = batch.mesh.components[0];
    for (std::size_t t = 0; t < triangles; ++t) {
      batch.mesh.triangles.push_back(corners(vertices));
      component.triangles.push_back(static_cast<std::int32_t>(t));
    }
    batch.mesh.component_of_triangle.assign(triangles, 0);
    for (Eigen::Index v = 0; v < vertices; ++v)
      component.vertices.push_back(static_cast<std::int32_t>(v));
    batch.primitive.q0 = moving_end(motion);
    batch.primitive.q1 = line ? moving_end(motion) : batch.primitive.q0;
    // Some lines keep their direction and length: the middle piece is then a cubic.
    if (line && engine_() % 3 == 0) {
      for (std::size_t k = 0; k < 3; ++k)
        batch.primitive.q1.t1[k] =
            batch.primitive.q0.t1[k] + (batch.primitive.q1.t0[k] - batch.primitive.q0.t0[k]);
    }
    return batch;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  double small_integer() { return static_cast<double>(engine_() % 5) - 2; }

  double number() {
    switch (family_) {
      case BatchFamily::generic:
      case BatchFamily::small_motion:
        return uniform();
      case BatchFamily::near_degenerate: {
        double x = small_integer();
        for (auto n = engine_() % 3; n > 0; --n) x = std::nextafter(x, engine_() % 2 ? 9 : -9);
        return x;
      }
      case BatchFamily::degenerate:
        return small_integer();
      case BatchFamily::far:
        return 1e6 + uniform();
      case BatchFamily::mixed_scales:
        return std::ldexp(uniform(), static_cast<int>(engine_() % 80) - 40);
      case BatchFamily::tiny:
        return engine_() % 4 ? small_integer() : std::ldexp(uniform(), -1050);
      case BatchFamily::huge:
        return std::ldexp(uniform(), engine_() % 2 ? 310 : 280);
    }
    return 0;
  }

  detector::MovingPoint moving_end(double motion) {
    detector::MovingPoint q;
    for (std::size_t k = 0; k < 3; ++k) {
      q.t0[k] = number();
      q.t1[k] = motion < 1 ? q.t0[k] + motion * number() : number();
    }
    return q;
  }

  std::array<std::int32_t, 3> corners(Eigen::Index vertices) {
    std::array<std::int32_t, 3> v{};
    do {
      for (auto& i : v) i = static_cast<std::int32_t>(engine_() % static_cast<unsigned>(vertices));
    } while (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]);
    return v;
  }

  std::mt19937_64 engine_;
  BatchFamily family_ = BatchFamily::generic;
};

}  // namespace assay::tests
