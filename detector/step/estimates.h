// What a step with views may save and cost, estimated before it is known. The cost model decides by
// these numbers (cost_model.h).
#pragma once

#include "detector/step/step_work.h"
#include "detector/view/view_signs.h"

namespace assay::detector {

// The share of pairs that are left out because both triangles lie in V+ or both in V-. Near pairs
// have equal signs more often than far ones, so of a component with p positive and n negative
// triangles of m, at least about (p^2 + n^2) / m^2 of the pairs are left out. Only triangles whose
// `counts` is not 0 are among the p and n; without `counts` all are.
double saved_share(const GivenStep& step, const StepMarks& marks,
                   const std::vector<std::uint8_t>* counts = nullptr);

// By triangle: 1 if it was in no contact with its own component in the step before.
// REQUIRES that the step goes on from one.
std::vector<std::uint8_t> untouched_before(const GivenStep& step);

// What a sample of a component's triangles has shown.
struct SampledSigns {
  std::size_t count = 0, positive = 0, negative = 0;
  ViewCounts rungs = {};

  double share_of(std::uint64_t n) const {
    return static_cast<double>(n) / static_cast<double>(count);
  }
  double saved() const {
    const double p = share_of(positive), n = share_of(negative);
    return p * p + n * n;
  }
  bool is_clear() const { return rungs.open == 0 && positive + negative >= count - count / 4; }
};

// Classifies `size` triangles, spread evenly over those given, in doubles alone.
SampledSigns sample_signs(const GivenStep& step, const ViewPrimitive& primitive,
                          std::span<const std::int32_t> triangles, std::size_t size);

// Whether more than `limit` triangles lie in the boxes of ghosts of components that are not free.
bool has_more_ghost_pairs(const GivenStep& step, const StepMarks& marks, double limit,
                          PacedStop& pace);

}  // namespace assay::detector
