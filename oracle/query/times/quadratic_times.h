// The zeros in the closed step of polynomials of degree 1 and 2, in order.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "oracle/query/times/exact_times.h"
#include "oracle/query/times/quadratic_time.h"

namespace assay::oracle {

class QuadraticTimes final : public ExactTimes {
 public:
  // Finds the distinct zeros in [0,1] of all the polynomials together, ascending. A constant has
  // none. REQUIRES that no polynomial is identically zero, and degrees <= 2.
  explicit QuadraticTimes(std::span<const IntegerPolynomial> polynomials);

  int size() const override;
  int sign(const IntegerPolynomial& q, int i) const override;
  detector::TimeEnclosure enclosure(int i) const override;
  // Gives the times away.
  std::vector<QuadraticTime> take() { return std::move(times_); }

 private:
  std::vector<QuadraticTime> times_;
};

}  // namespace assay::oracle
