// The zeros of polynomials in the closed step as exact algebraic numbers, by CGAL's algebraic
// kernel.
//
// The kernel stays behind this header. Its numbers are reference counted without regard to
// threads, so an object belongs to the thread that made it.
#pragma once

#include <memory>
#include <span>

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

class AlgebraicTimes {
 public:
  // Finds the distinct zeros in [0,1] of all the polynomials together, ascending. REQUIRES that no
  // polynomial is identically zero.
  explicit AlgebraicTimes(std::span<const IntegerPolynomial> polynomials);
  ~AlgebraicTimes();
  AlgebraicTimes(const AlgebraicTimes&) = delete;
  AlgebraicTimes& operator=(const AlgebraicTimes&) = delete;

  int size() const;
  // The exact sign of q at the i-th time.
  int sign(const IntegerPolynomial& q, int i) const;
  detector::TimeEnclosure enclosure(int i) const;

 private:
  struct Zeros;
  std::unique_ptr<Zeros> zeros_;
};

}  // namespace assay::oracle
