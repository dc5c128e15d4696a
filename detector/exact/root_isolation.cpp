#include "detector/exact/root_isolation.h"

#include "detector/exact/root_bracket.h"
#include "detector/exact/root_cluster.h"

namespace assay::detector {
namespace {

// Between two doubles; lo == hi is a root.
struct Part {
  double lo, hi;
  SignChanges changes;
};

}  // namespace

std::vector<IsolatedRoot> isolate_roots(const Polynomial& f, SignChanges over_unit, Roots wanted) {
  std::vector<IsolatedRoot> found;
  std::vector<Part> open = {{0, 1, over_unit}};  // the first one is last
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
      const double time = from_ordinal((ordinal(part.lo) + ordinal(part.hi)) / 2);
      const Dyadic middle = Dyadic::of(time);
      open.push_back({time, part.hi, sign_changes_over(f, middle, hi)});
      if (f.sign_at(middle) == 0) open.push_back({time, time, {}});
      open.push_back({part.lo, time, sign_changes_over(f, lo, middle)});
    }
  }
  return found;
}

}  // namespace assay::detector
