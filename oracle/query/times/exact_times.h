// Times of the closed step as exact numbers, whichever way they are held.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// Distinct times in [0,1], ascending.
class ExactTimes {
 public:
  ExactTimes() = default;
  virtual ~ExactTimes() = default;
  ExactTimes(const ExactTimes&) = delete;
  ExactTimes& operator=(const ExactTimes&) = delete;

  virtual int size() const = 0;
  // The exact sign of q at the i-th time.
  virtual int sign(const IntegerPolynomial& q, int i) const = 0;
  virtual detector::TimeEnclosure enclosure(int i) const = 0;
};

}  // namespace assay::oracle
