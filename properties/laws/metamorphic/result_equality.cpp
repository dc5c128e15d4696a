#include "properties/laws/metamorphic/result_equality.h"

#include <algorithm>
#include <cstring>

#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"
#include "detector/step_result.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using detector::PairContact;

// Compares bits, so that -0 differs from 0.
bool same(const MovingPoint& a, const MovingPoint& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same(const detector::ViewPrimitive& a, const detector::ViewPrimitive& b) {
  return same(a.q0, b.q0) && same(a.q1, b.q1);
}

bool same(const PairContact& a, const PairContact& b) {
  return a.pair == b.pair && a.time == b.time && a.feature.kind == b.feature.kind &&
         a.feature.vertices == b.feature.vertices;
}

template <class List>
bool same_lists(const List& a, const List& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

// The counts that are compared. Those of marking depend on earlier steps too
// (detector/search/pair_rule.h), and so may those that are set to 0 beside them.
detector::StepCounts of_this_step(detector::StepCounts counts) {
  counts.marking = {};
  counts.search.child_counts = counts.search.skipped = counts.search.contour_tests = 0;
  counts.view.open = counts.ghosts.box_tests = 0;
  return counts;
}

bool same_counts(const detector::StepCounts& a, const detector::StepCounts& b) {
  const auto one = of_this_step(a), other = of_this_step(b);
  return std::memcmp(&one, &other, sizeof one) == 0;
}

}  // namespace

std::string difference(const detector::StepResult& a, const detector::StepResult& b) {
  if (a.answer != b.answer) return "answer";
  if (a.problem.has_value() != b.problem.has_value()) return "problem";
  if (a.problem && a.problem->error != b.problem->error) return "problem";
  if (a.first != b.first) return "first time";
  if (!same_lists(a.pairs, b.pairs)) return "pairs";
  if (a.views != b.views) return "use of views";
  if (a.doubts != b.doubts) return "doubts";
  if (a.signs != b.signs) return "signs";
  if (a.view_positive != b.view_positive || a.view_negative != b.view_negative ||
      a.view_zero != b.view_zero || a.against_all != b.against_all || a.violated != b.violated ||
      a.dirty != b.dirty) {
    return "sizes of view sets";
  }
  if (!same_lists(a.primitives, b.primitives)) return "primitives";
  if (!same_lists(a.apexes, b.apexes)) return "apexes";
  if (!same_counts(a.counts, b.counts)) return "counts";
  return {};
}

}  // namespace assay::properties
