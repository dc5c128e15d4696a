// The built-in detector behind a wrapper that rounds its input, as some engines do that count as
// exact. ASSAY_TEST_ROUNDING says in which way. It claims what such an engine claims: it misses
// nothing from starts that are free, and its times have some tolerance.
#include <Eigen/Core>
#include <algorithm>
#include <cstdlib>
#include <string>

#include "detector/detector.h"
#include "detector/plugin/assay_detector.hpp"

namespace {

using namespace assay::plugin;
namespace detector = assay::detector;

// Boxes in floats, as centre and half of the size, none of which is rounded outwards.
struct FloatBox {
  Eigen::Array3f centre, half;
  bool meets(const FloatBox& other) const {
    return ((centre - other.centre).abs() <= half + other.half).all();
  }
};

class Rounding {
 public:
  static Description describe() {
    Description d;
    static const std::string name = "rounds on the way: " + way();
    d.name = name.c_str();
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_DETERMINISTIC |
               ASSAY_CLAIM_TOTAL;
    d.start = ASSAY_START_FREE;
    d.time_tolerance = 1e-6;
    d.least_nonzero = 1e-6;
    d.largest = 1e6;
    return d;
  }

  explicit Rounding(const Mesh& mesh) : triangles_(eigen(mesh.triangles)) {}

  Result evaluate(Positions given_t0, Positions given_t1) {
    detector::Positions x_t0 = eigen(given_t0), x_t1 = eigen(given_t1);
    round(x_t0, x_t1);
    auto made = detector::Detector::create(triangles_, x_t0, {detector::Culling::bvh});
    if (!made) throw Refused(made.error().message);
    const auto found = made.value().evaluate(x_t0, x_t1);
    if (found.answer == detector::Answer::error) return Result::error("refused");
    double first = 2;
    for (const auto& contact : found.pairs) {
      const bool is_kept =
          way() != "float boxes" ||
          box_of(contact.pair.a, x_t0, x_t1).meets(box_of(contact.pair.b, x_t0, x_t1));
      if (is_kept) first = std::min(first, contact.time.lo);
    }
    return first > 1 ? Result::free() : Result::collision(first, first);
  }

  void commit() {}

 private:
  static std::string way() {
    const char* word = std::getenv("ASSAY_TEST_ROUNDING");
    return word ? word : "not at all";
  }

  void round(detector::Positions& x_t0, detector::Positions& x_t1) const {
    const detector::Positions moved = x_t1 - x_t0;
    if (way() == "displacement") x_t1 = x_t0 + moved;
    if (way() == "velocity") x_t1 = x_t0 + moved / (1. / 60) * (1. / 60);
    if (way() == "first vertex") {
      const Eigen::RowVector3d origin = x_t0.row(0);
      x_t0.rowwise() -= origin;
      x_t1.rowwise() -= origin;
    }
    if (way() == "millimetres") x_t0 *= 1000, x_t1 *= 1000;
    if (way() == "extent") {
      const double extent = (x_t0.colwise().maxCoeff() - x_t0.colwise().minCoeff()).maxCoeff();
      if (extent > 0) x_t0 /= extent, x_t1 /= extent;
    }
  }

  FloatBox box_of(std::int32_t t, const detector::Positions& x_t0,
                  const detector::Positions& x_t1) const {
    Eigen::Array3d low = x_t0.row(triangles_(t, 0)).transpose(), high = low;
    for (const auto* x : {&x_t0, &x_t1}) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Array3d p = x->row(triangles_(t, k)).transpose();
        low = low.min(p);
        high = high.max(p);
      }
    }
    return {((low + high) / 2).cast<float>(), ((high - low) / 2).cast<float>()};
  }

  detector::Triangles triangles_;
};

}  // namespace

ASSAY_EXPORT_DETECTOR(Rounding);
