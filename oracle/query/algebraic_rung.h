// The rung "algebraic": the complete exact test. It takes 0.1 to 0.4 ms; if the exponents of the
// coordinates spread over all doubles, 7 ms on average and up to 0.1 s.
#pragma once

#include <optional>
#include <vector>

#include "oracle/query/algebraic_times.h"
#include "oracle/query/contact_polynomials.h"

namespace assay::oracle {

struct AlgebraicAnswer {
  bool contact = false;
  detector::TimeEnclosure first;  // set when there is a contact and a time was wanted
};

// Tests the contact condition at each time at which a contact can begin (notation of
// four_points.h):
// - These are the zeros of F, if F is not identically zero.
// - Else t=0 and the zeros of the L of an axis whose L are not all identically zero.
// - If all L are, t=0 and the zeros of the D of an axis whose D are not all; else t=0 alone.
// Between these times nothing changes, and the set of contact times is closed, so the first of
// them with a contact is the answer.
AlgebraicAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want);

// The polynomials whose zeros in [0,1] are these times; none is identically zero.
std::vector<IntegerPolynomial> event_polynomials(ContactPolynomials& polynomials);

// Whether there is a contact at the i-th time. REQUIRES that F is zero at that time.
bool contact_at(ContactPolynomials& polynomials, const AlgebraicTimes& times, int i);

}  // namespace assay::oracle
