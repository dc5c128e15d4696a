// Rung "algebraic": the complete exact test. 0.1 to 0.4 ms; 7 ms on average and up to 0.1 s when
// the exponents of the coordinates spread over all doubles.
#pragma once

#include <optional>
#include <vector>

#include "oracle/query/algebraic_times.h"
#include "oracle/query/contact_polynomials.h"

namespace assay::oracle {

struct AlgebraicAnswer {
  bool contact = false;
  detector::TimeEnclosure first;  // when contact, and a time was wanted
};

// Tests the contact condition at each time where it can begin: the zeros of F; when F is
// identically zero, t=0 and the zeros of the L of one axis where they are not all zero; when all L
// are, t=0 and the zeros of the D of such an axis; else t=0. Between these times nothing changes,
// and the set of contact times is closed, so the first of them with a contact is the answer.
AlgebraicAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want);

// The polynomials among whose zeros in [0,1] a contact begins; none is identically zero.
std::vector<IntegerPolynomial> event_polynomials(ContactPolynomials& polynomials);

// The contact condition at the i-th time, at which F must be zero.
bool contact_at(ContactPolynomials& polynomials, const AlgebraicTimes& times, int i);

}  // namespace assay::oracle
