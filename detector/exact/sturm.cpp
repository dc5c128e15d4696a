#include "detector/exact/sturm.h"

#include <cassert>

namespace assay::detector {

SignedRemainders::SignedRemainders(const Polynomial& f, const Polynomial& second) {
  assert(!f.is_zero());
  sequence_.push_back(f);
  Polynomial next = second;
  while (!next.is_zero()) {
    sequence_.push_back(next);
    const auto n = sequence_.size();
    // Coefficients of the remainders double in length at each step: take out common factors
    // unless the sequence is about to end anyway.
    next = -sequence_[n - 2].remainder(sequence_[n - 1]);
    if (next.degree() > 0) next = next.primitive_part();
  }
}

int SignedRemainders::variations_at(const Dyadic& time) const {
  int variations = 0, previous = 0;
  for (const auto& p : sequence_) {
    const int sign = p.sign_at(time);
    if (sign == 0) continue;
    if (previous != 0 && sign != previous) ++variations;
    previous = sign;
  }
  return variations;
}

}  // namespace assay::detector
