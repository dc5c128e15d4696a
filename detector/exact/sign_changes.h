// Descartes' rule: how often the coefficients of a polynomial in the Bernstein basis over an
// interval change their sign, zeros left out. The number of roots in the OPEN interval, counted
// with their multiplicities, is that number or an even number less. So there is none without a
// change, and exactly one, a simple one, with one; roots at the ends do not matter.
//
// For a polynomial without multiple roots the count becomes 0 or 1 as intervals become short: it is
// 0 when no complex root lies in the disc over the interval, and 1 when exactly one lies in the
// union of the discs around the two equilateral triangles over it (Krandick, Mehlhorn, New bounds
// for the Descartes method, J. Symb. Comput. 41, 2006).
#pragma once

#include "detector/exact/polynomial.h"

namespace assay::detector {

struct SignChanges {
  // Exact up to 1. From 2 on it may be smaller than the true one, but is 2 at least.
  int count = 0;
  // With a count of 0 or 1: the sign of the polynomial after the interval's beginning (0 only if
  // it is 0 everywhere).
  int first = 0;
};

// Over (lo,hi) in [0,1]; lo < hi. 0.5 us where balls tell.
SignChanges sign_changes_over(const Polynomial& f, const Dyadic& lo, const Dyadic& hi);

// Over (0,1).
SignChanges sign_changes_over_unit(const Polynomial& f);

}  // namespace assay::detector
