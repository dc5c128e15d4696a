// Isolates the distinct real roots of a square-free polynomial in the open interval (0,1): each
// gets an interval of its own.
//
// Method: Descartes' rule (sign_changes.h) over intervals that are split. The parts have equally
// many DOUBLES, not equal lengths (those from 0 are split by exponents), so that an interval is
// split some 70 times at most, whatever the exponents are. root_cluster.h tells apart roots that
// lie in one gap between adjacent doubles. Intervals wait in a list, so the stack does not grow
// with their number.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/exact/sign_changes.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Either a known time, or an open interval with one root in it, a simple one.
struct IsolatedRoot {
  Dyadic lo, hi;          // an interval, or both the root itself if it is a time
  TimeEnclosure doubles;  // lo and hi, or the adjacent doubles around them
  // The sign of the polynomial between lo and the root; 0 if the root is a time.
  int sign_after_lo = 0;
  bool is_time() const { return sign_after_lo == 0; }
};

enum class Roots : std::uint8_t { all, any };

// The roots, ascending; with Roots::any, one of them if there is one. REQUIRES that `f` is
// square-free and has the sign changes over_unit over (0,1).
std::vector<IsolatedRoot> isolate_roots(const Polynomial& f, SignChanges over_unit, Roots wanted);

}  // namespace assay::detector
