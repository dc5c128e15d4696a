#include "detector/exact/sturm.h"

#include <cassert>

namespace assay::detector {

// Subresultants (Collins; Cohen, A Course in Computational Algebraic Number Theory, Algorithm
// 3.3.7): each pseudo-remainder is divided by a factor that is known to divide it, so that the
// coefficients grow by a constant length a step, as determinants of coefficients, without any
// greatest common divisor. Here the factors are taken by their sizes: signs stay those of the
// remainders themselves.
SignedRemainders::SignedRemainders(const Polynomial& f, const Polynomial& second) {
  assert(!f.is_zero());
  sequence_.push_back(f);
  if (second.is_zero()) return;
  sequence_.push_back(second);
  if (f.degree() < second.degree()) sequence_.push_back(-f);  // its own remainder
  Integer g = 1, h = 1;
  while (true) {
    const Polynomial &a = sequence_[sequence_.size() - 2], &b = sequence_.back();
    const auto step = static_cast<unsigned>(a.degree() - b.degree());
    Polynomial next = -a.remainder(b);
    if (next.is_zero()) return;
    if (next.degree() == 0) {  // the last one: only its sign counts
      sequence_.push_back(std::move(next));
      return;
    }
    next.divide_exactly(g * pow(h, step));
    g = abs(b.leading());
    // g^step h^(1-step), an integer.
    if (step > 0) h = pow(g, step) / pow(h, step - 1);
    sequence_.push_back(std::move(next));
  }
}

int SignedRemainders::variations_at(const Dyadic& time) const {
  return variations_at(time, sequence_.front().sign_at(time));
}

int SignedRemainders::variations_at(const Dyadic& time, int sign_of_f) const {
  int variations = 0, previous = sign_of_f;
  for (std::size_t i = 1; i < sequence_.size(); ++i) {
    const int sign = sequence_[i].sign_at(time);
    if (sign == 0) continue;
    if (previous != 0 && sign != previous) ++variations;
    previous = sign;
  }
  return variations;
}

}  // namespace assay::detector
