// Signs at roots and numbers of roots by signed remainder sequences (Basu, Pollack, Roy, Algorithms
// in Real Algebraic Geometry, Theorem 2.61): a referee for the roots of the detector, which finds
// and compares roots in another way.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"

namespace assay::tests {

// Returns the sum of the signs of q at the distinct roots of f in (lo, hi). REQUIRES that f is not
// 0 at lo and hi.
inline int tarski_query(const detector::Polynomial& f, const detector::Polynomial& q,
                        const detector::Dyadic& lo, const detector::Dyadic& hi) {
  using detector::Polynomial;
  std::vector<Polynomial> sequence = {f};
  Polynomial next = f.derivative() * q;
  // A degree above that of f: f is its own remainder, with the other sign.
  if (next.degree() > f.degree()) {
    sequence.push_back(next);
    next = -f;
  }
  while (!next.is_zero()) {
    sequence.push_back(next);
    next = -sequence[sequence.size() - 2].remainder(sequence.back());
  }
  const auto variations_at = [&sequence](const detector::Dyadic& time) {
    int variations = 0, previous = 0;
    for (const auto& p : sequence) {
      const int sign = p.sign_at(time);
      if (sign == 0) continue;
      variations += previous != 0 && sign != previous;
      previous = sign;
    }
    return variations;
  };
  return variations_at(lo) - variations_at(hi);
}

inline int number_of_roots(const detector::Polynomial& f, const detector::Dyadic& lo,
                           const detector::Dyadic& hi) {
  return tarski_query(f, detector::Polynomial::constant(1), lo, hi);
}

}  // namespace assay::tests
