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

bool same_counts(const detector::StepCounts& a, const detector::StepCounts& b) {
  const auto list = [](const detector::StepCounts& c) {
    return std::array{c.search.box_tests,
                      c.search.candidate_pairs,
                      c.narrow.elementary_tests,
                      c.narrow.rungs.axis,
                      c.narrow.rungs.filter,
                      c.narrow.rungs.fixed,
                      c.narrow.rungs.unbounded,
                      c.narrow.rungs.open,
                      c.view.lanes,
                      c.view.filter,
                      c.view.exact,
                      c.ghosts.pairs,
                      c.ghosts.elementary_tests,
                      c.ghosts.near_triangles,
                      c.release.in_doubt,
                      c.release.released,
                      c.release.pairs,
                      c.release.elementary_tests,
                      c.release.winding_numbers,
                      c.closure_rounds,
                      c.winding_numbers,
                      c.free_components};
  };
  return list(a) == list(b);
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
