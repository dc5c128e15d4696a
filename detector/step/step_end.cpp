#include "detector/step/step_end.h"

#include <algorithm>

#include "detector/step_result.h"

namespace assay::detector {

TriangleType type_of(const StepMarks& marks, std::size_t t) {
  if (!marks.clean[t]) return TriangleType::dirty;
  // A type that is tested against everything, but, unlike `dirty`, not for piercing its own
  // component at t=0: what is clean pierces nothing there.
  if (!marks.has_views()) return TriangleType::violated;
  if (marks.touched[t]) return TriangleType::violated;
  return marks.signs[t] == ViewSign::positive   ? TriangleType::positive
         : marks.signs[t] == ViewSign::negative ? TriangleType::negative
                                                : TriangleType::zero;
}

void count_sets(const StepMarks& marks, StepResult& result) {
  const std::size_t count = marks.clean.size();
  result.doubts.assign(count, 0);
  if (marks.all_free()) {  // all is positive, clean and touched by no ghost
    result.view_positive = count;
    return;
  }
  for (std::size_t t = 0; t < count; ++t) {
    const bool dirty = !marks.clean[t], violated = marks.touched[t] != 0;
    result.doubts[t] =
        static_cast<std::uint8_t>((violated ? doubt::violated : 0) | (dirty ? doubt::dirty : 0));
    result.dirty += dirty;
    result.violated += violated;
    switch (type_of(marks, t)) {
      case TriangleType::positive:
        ++result.view_positive;
        break;
      case TriangleType::negative:
        ++result.view_negative;
        break;
      case TriangleType::zero:
        ++result.view_zero;
        break;
      default:
        ++result.against_all;
    }
  }
}

// The least lo and the least hi, each by itself. No contact is before the least lo, and by each hi
// below 1 there is a contact. For unique enclosures the result is the least of them.
TimeEnclosure least_time(std::span<const PairContact> pairs) {
  if (pairs.empty()) return {};
  TimeEnclosure least = pairs.front().time;
  for (const auto& contact : pairs) {
    least.lo = std::min(least.lo, contact.time.lo);
    least.hi = std::min(least.hi, contact.time.hi);
  }
  return least;
}

}  // namespace assay::detector
