// Descartes' rule counts how often the coefficients of a polynomial in the Bernstein basis over an
// interval change their sign, with zeros left out. The number of roots in the OPEN interval,
// counted with their multiplicities, is that count or less by an even number. So with no change
// there is no root, and with one change there is exactly one, a simple one. Roots at the ends of
// the interval do not matter.
//
// For a polynomial without multiple roots the count becomes 0 or 1 as intervals become short. It
// is 0 if no complex root lies in the disc over the interval, and 1 if exactly one lies in the
// union of the discs around the two equilateral triangles over it (Krandick, Mehlhorn, New bounds
// for the Descartes method, J. Symb. Comput. 41, 2006).
#pragma once

#include "detector/exact/polynomial.h"

namespace assay::detector {

struct SignChanges {
  // The number of sign changes. 0 and 1 are exact. If the true number is 2 or more, this may be
  // smaller, but is 2 at least.
  int count = 0;
  // With a count of 0 or 1: the sign of the polynomial just after the interval's beginning (0 only
  // if it is 0 everywhere).
  int first = 0;
};

// The changes over (lo,hi). REQUIRES 0 <= lo < hi <= 1. 0.5 us if balls can tell.
SignChanges sign_changes_over(const Polynomial& f, const Dyadic& lo, const Dyadic& hi);

// The changes over (0,1).
SignChanges sign_changes_over_unit(const Polynomial& f);

}  // namespace assay::detector
