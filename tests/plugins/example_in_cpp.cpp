// A detector by spheres: two triangles collide if the spheres around their paths meet. It never
// misses a contact, and claims this alone; it often reports a contact falsely.
#include <cmath>

#include "detector/plugin/assay_detector.hpp"
using namespace assay::plugin;

struct Spheres {
  static Description describe() {
    Description d;  // what is not named leaves nothing out
    d.name = "swept spheres";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_TOTAL;
    d.least_nonzero = 1e-100, d.largest = 1e100;  // squares of it are numbers too
    return d;
  }
  explicit Spheres(const Mesh& mesh)  // it copies: the host's array is gone afterwards
      : corners(mesh.triangles[0], mesh.triangles[mesh.triangles.size()]) {}

  static double distance(const double* p, const double* q) {
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  double radius(Positions x_t0, Positions x_t1, std::size_t t) const {
    double most = 0;
    for (std::size_t i = 0; i < 6; ++i)
      most = std::max(
          most, distance(x_t0[corners[3 * t]], (i < 3 ? x_t0 : x_t1)[corners[3 * t + i % 3]]));
    return most * (1 + 1e-9);  // more than all rounding
  }
  Result evaluate(Positions x_t0, Positions x_t1) const {
    Result result = Result::collision();  // at some time in [0, 1]
    for (std::size_t b = 1; 3 * b < corners.size(); ++b)
      for (std::size_t a = 0; a < b; ++a)
        if (distance(x_t0[corners[3 * a]], x_t0[corners[3 * b]]) * (1 - 1e-9) <=
            radius(x_t0, x_t1, a) + radius(x_t0, x_t1, b))
          result.add(int(a), int(b));
    return result.pairs.empty() ? Result::free() : result;
  }
  std::vector<std::int32_t> corners;
};
ASSAY_EXPORT_DETECTOR(Spheres);
