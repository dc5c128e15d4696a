#include "detector/step/step_end.h"

#include <algorithm>

#include "detector/step_result.h"

namespace assay::detector {

TriangleType type_of(const StepWork& work, std::size_t t) {
  if (!work.clean[t]) return TriangleType::dirty;
  // Against everything; but what is clean pierces nothing of its own component.
  if (!work.has_views()) return TriangleType::violated;
  if (work.touched[t]) return TriangleType::violated;
  return work.signs[t] == ViewSign::positive   ? TriangleType::positive
         : work.signs[t] == ViewSign::negative ? TriangleType::negative
                                               : TriangleType::zero;
}

void count_sets(const StepWork& work, StepResult& result) {
  const std::size_t count = work.surface.mesh.triangles.size();
  result.doubts.assign(count, 0);
  if (work.all_free()) {  // and so clean, and touched by no ghost
    result.view_positive = count;
    return;
  }
  for (std::size_t t = 0; t < count; ++t) {
    const bool dirty = !work.clean[t], violated = work.touched[t] != 0;
    result.doubts[t] =
        static_cast<std::uint8_t>((violated ? doubt::violated : 0) | (dirty ? doubt::dirty : 0));
    result.dirty += dirty;
    result.violated += violated;
    switch (type_of(work, t)) {
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

// Nothing is before the least lo, and each hi below 1 is one by which there is a contact. Of unique
// enclosures this is the least.
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
