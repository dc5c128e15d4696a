// Signed remainder sequences: root counts and sign sums without any root.
#pragma once

#include <boost/container/small_vector.hpp>

#include "detector/exact/polynomial.h"

namespace assay::detector {

class SignedRemainders {
 public:
  // The sequence of (f, second): with second = f' its variations count the distinct roots of f,
  // with second = f'q they add up the signs of q at those roots. f must not be zero.
  SignedRemainders(const Polynomial& f, const Polynomial& second);

  // Sign variations of the sequence at a time that is no root of f.
  int variations_at(const Dyadic& time) const;
  // The same where the sign of f there is known.
  int variations_at(const Dyadic& time, int sign_of_f) const;
  // A greatest common divisor of f and second.
  const Polynomial& last() const { return sequence_.back(); }

 private:
  boost::container::small_vector<Polynomial, 7> sequence_;
};

}  // namespace assay::detector
