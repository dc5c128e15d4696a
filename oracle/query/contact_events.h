// When a contact can begin, and whether it does: what all exact rungs share (notation of
// four_points.h).
#pragma once

#include <vector>

#include "oracle/query/contact_polynomials.h"
#include "oracle/query/times/exact_times.h"

namespace assay::oracle {

// What an exact rung answers.
struct ExactAnswer {
  bool contact = false;
  detector::TimeEnclosure first;  // set when there is a contact and a time was wanted
};

// The polynomials whose zeros in [0,1] are the times at which a contact can begin; none is
// identically zero.
// - These times are the zeros of F, if F is not identically zero.
// - Else t=0 and the zeros of the L of an axis whose L are not all identically zero.
// - If all L are, t=0 and the zeros of the D of an axis whose D are not all; else t=0 alone.
// Between these times nothing changes, and the set of contact times is closed, so the first of
// them with a contact is the first time of all.
std::vector<IntegerPolynomial> event_polynomials(ContactPolynomials& polynomials);

// Whether there is a contact at the i-th time. REQUIRES that F is zero at that time.
bool contact_at(ContactPolynomials& polynomials, const ExactTimes& times, int i);

// The answer, given all times at which a contact can begin.
ExactAnswer first_contact(ContactPolynomials& polynomials, const ExactTimes& times,
                          detector::Want want);

}  // namespace assay::oracle
