#include "detector/exact/root_isolation.h"

#include <cmath>

#include "detector/exact/root_bracket.h"
#include "detector/exact/root_cluster.h"

namespace assay::detector {
namespace {

// The open interval between two doubles, or a root at lo == hi.
struct Part {
  double lo, hi;
  SignChanges changes;
};

// A double between lo and hi: the middle in the order of doubles. In (0,1) that would be about
// 2^-512, but most roots are of ordinary size. So intervals that begin at 0 are split at 1/2,
// 2^-3, 2^-7, and so on down to 2^-1023.
double split(double lo, double hi) {
  constexpr int last_exponent = -511;
  if (lo == 0 && hi >= std::ldexp(1, last_exponent)) return std::ldexp(1, 2 * std::ilogb(hi) - 1);
  return from_ordinal((ordinal(lo) + ordinal(hi)) / 2);
}

}  // namespace

std::vector<IsolatedRoot> isolate_roots(const Polynomial& f, SignChanges over_unit, Roots wanted) {
  std::vector<IsolatedRoot> found;
  std::vector<Part> open = {{0, 1, over_unit}};  // parts to look at; the next one is last
  while (!open.empty() && (found.empty() || wanted == Roots::all)) {
    const Part part = open.back();
    open.pop_back();
    const TimeEnclosure doubles{part.lo, part.hi};
    const Dyadic lo = Dyadic::of(part.lo), hi = Dyadic::of(part.hi);
    if (part.lo == part.hi) {
      found.push_back({lo, hi, doubles, 0});
    } else if (part.changes.count == 1) {
      found.push_back({lo, hi, doubles, part.changes.first});
    } else if (part.changes.count >= 2 && adjacent(part.lo, part.hi)) {
      isolate_in_gap(f, doubles, wanted, found);
    } else if (part.changes.count >= 2) {
      const double time = split(part.lo, part.hi);
      const Dyadic middle = Dyadic::of(time);
      open.push_back({time, part.hi, sign_changes_over(f, middle, hi)});
      if (f.sign_at(middle) == 0) open.push_back({time, time, {}});
      open.push_back({part.lo, time, sign_changes_over(f, lo, middle)});
    }
  }
  return found;
}

}  // namespace assay::detector
