#include "oracle/query/algebraic_answer.h"

#include "oracle/query/times/algebraic_times.h"

namespace assay::oracle {

ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want) {
  return first_contact(polynomials, AlgebraicTimes(event_polynomials(polynomials)), want);
}

}  // namespace assay::oracle
