// The roots of a cubic in closed form, as the textbooks have it.
#pragma once

#include "corpus/peers/cubic.h"

namespace assay::peers {

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

}  // namespace assay::peers
