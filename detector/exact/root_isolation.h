// The distinct real roots of a square-free polynomial in the open interval (0,1), each by itself.
//
// Method: Descartes' rule (sign_changes.h) over intervals that are halved in the order of the
// DOUBLES as integers, some 70 times at most whatever the exponents are. Roots that share one gap
// between adjacent doubles are told apart there (root_cluster.h). Intervals wait in a list, so the
// stack does not grow with their number.
#pragma once

#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/exact/sign_changes.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Either a time, or an open interval with one root in it, a simple one.
struct IsolatedRoot {
  Dyadic lo, hi;          // both the root itself where it is a time
  TimeEnclosure doubles;  // lo and hi, or the adjacent doubles around them
  int sign_after_lo = 0;  // of the polynomial in the interval; 0: a time
  bool is_time() const { return sign_after_lo == 0; }
};

enum class Roots : std::uint8_t { all, any };

// Ascending; of `any` one of them, if there is one. `f` is square-free, with these sign changes
// over (0,1).
std::vector<IsolatedRoot> isolate_roots(const Polynomial& f, SignChanges over_unit, Roots wanted);

}  // namespace assay::detector
