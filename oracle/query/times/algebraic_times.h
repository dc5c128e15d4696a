// The zeros of polynomials in the closed step as exact algebraic numbers, by CGAL's algebraic
// kernel.
//
// The kernel stays behind this header. Its numbers are reference counted without regard to
// threads, so an object belongs to the thread that made it.
#pragma once

#include <memory>
#include <span>

#include "oracle/query/times/time_enclosure.h"

namespace assay::oracle {

class AlgebraicTimes final : public ExactTimes {
 public:
  // Finds the distinct zeros in [0,1] of all the polynomials together, ascending. REQUIRES that no
  // polynomial is identically zero.
  explicit AlgebraicTimes(std::span<const IntegerPolynomial> polynomials);
  ~AlgebraicTimes() override;

  int size() const override;
  int sign(const IntegerPolynomial& q, int i) const override;
  detector::TimeEnclosure enclosure(int i) const override;

 private:
  struct Zeros;
  std::unique_ptr<Zeros> zeros_;
};

}  // namespace assay::oracle
