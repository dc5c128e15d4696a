// The textbook method (cubic.h) with the roots in closed form. ASSAY_PEER_NUMBERS chooses Doubles
// or Floats; on graphics cards the method runs in floats.
//
// Version: 1, of this file. Settings: one tolerance, of barycentric coordinates and of times. It is
// 1e-6 in doubles and 1e-5 in floats (some 80 steps of a float below 1). In floats, coefficients
// below 1e-7 of the greatest coefficient are treated as zero. Contract: no contact at the start,
// coordinates of usual sizes (float32 coordinates, if it is built in floats), times within the
// tolerance. Claims: free-sound and not-late, because Bridson, Fedkiw and Anderson, Robust
// treatment of collisions, contact and friction for cloth animation (2002), section 6.1, offer the
// same test ("we check for interference at the roots") and say that it finds all collisions of a
// step; total and deterministic, because it is a function of its arguments. The paper promises this
// without a word on rounding or arithmetic.
//
// As a limiter (limiter.h) it stops at 0.9 of the first time, as solvers with a line search do (Li
// et al., Incremental potential contact, 2020, scale the time of a collision before they step).
// Claims: commit-free and path-free, because of the same promise of the paper: if the first time is
// the time of the first collision, a step that stops a tenth earlier is free.
#include "corpus/peers/cubic.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

// `Settings` has `using Number`, `tolerance` (cubic.h) and `small`: a coefficient that is less
// than this share of the greatest one counts as zero.
template <class Settings>
struct ClosedForm : Settings {
  using Number = typename Settings::Number;

  static Roots<Number> roots_of(Number a, Number b, Number c, Number d) {
    Roots<Number> roots;
    const Number scale = std::max({std::abs(a), std::abs(b), std::abs(c), std::abs(d)});
    const Number small = Settings::small * scale;
    if (std::abs(a) > small) {
      const Number p = b / a, q = c / a, r = d / a;
      const Number u = (p * p - 3 * q) / 9, v = (2 * p * p * p - 9 * p * q + 27 * r) / 54;
      if (v * v < u * u * u) {
        const Number angle = std::acos(std::clamp(v / std::sqrt(u * u * u), Number(-1), Number(1)));
        const Number turn = 2 * std::acos(Number(-1));
        for (const Number k : {Number(0), Number(1), Number(-1)})
          roots.add(-2 * std::sqrt(u) * std::cos((angle + k * turn) / 3) - p / 3);
      } else {
        const Number w = -std::copysign(std::cbrt(std::abs(v) + std::sqrt(v * v - u * u * u)), v);
        roots.add(w + (w == 0 ? 0 : u / w) - p / 3);
      }
    } else if (std::abs(b) > small) {
      const Number discriminant = c * c - 4 * b * d;
      if (discriminant < 0) return roots;
      const Number h = Number(-.5) * (c + std::copysign(std::sqrt(discriminant), c));
      roots.add(h / b);
      if (h != 0) roots.add(d / h);
    } else if (std::abs(c) > small) {
      roots.add(-d / c);
    }
    return roots;
  }
};

struct Doubles {
  using Number = double;
  static constexpr double tolerance = 1e-6, small = 1e-12, time_tolerance = tolerance;
  static constexpr auto coordinates = ASSAY_COORDINATES_FLOAT64;
  static constexpr auto name =
      ASSAY_PEER_LIMIT ? "cubic in doubles, 0.9 of its time" : "cubic in doubles, tolerance 1e-6";
};

struct Floats {
  using Number = float;
  static constexpr float tolerance = 1e-5f, small = 1e-7f;
  static constexpr double time_tolerance = 1e-5;
  static constexpr auto coordinates = ASSAY_COORDINATES_FLOAT32;
  static constexpr auto name = "cubic in floats, tolerance 1e-5";
};

using Numbers = ASSAY_PEER_NUMBERS;

struct CubicClosed : FeaturePairs<CubicTests<ClosedForm<Numbers>>> {
  static constexpr double part_of_time = .9;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_COMMIT_FREE | ASSAY_CLAIM_PATH_FREE;

  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    plugin::Description d = cubic_description();
    d.name = Numbers::name;
    d.coordinates = Numbers::coordinates;
    d.time_tolerance = Numbers::time_tolerance;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::CubicClosed>);
