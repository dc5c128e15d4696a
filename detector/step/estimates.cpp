#include "detector/step/estimates.h"

#include <atomic>

#include "detector/parallel/for_all.h"

namespace assay::detector {

double saved_share(const GivenStep& step, const StepMarks& marks,
                   const std::vector<std::uint8_t>* counts) {
  double saved = 0, count = 0;
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    std::size_t positive = 0, negative = 0;
    for (const auto t : step.own_triangles(c)) {
      if (counts && (*counts)[at(t)] == 0) continue;
      positive += marks.signs[at(t)] == ViewSign::positive;
      negative += marks.signs[at(t)] == ViewSign::negative;
    }
    const auto p = static_cast<double>(positive), n = static_cast<double>(negative),
               m = static_cast<double>(step.own_triangles(c).size());
    saved += (p * p + n * n) / m;
    count += m;
  }
  return saved / count;
}

std::vector<std::uint8_t> untouched_before(const GivenStep& step) {
  std::vector<std::uint8_t> untouched(step.surface.mesh.triangles.size(), 1);
  for (const auto& pair : step.known->met) untouched[at(pair.a)] = untouched[at(pair.b)] = 0;
  return untouched;
}

SampledSigns sample_signs(const GivenStep& step, const ViewPrimitive& primitive,
                          std::span<const std::int32_t> triangles, std::size_t size) {
  SampledSigns sample{.count = size};
  for (std::size_t i = 0; i < size; ++i) {
    const auto& v = step.surface.mesh.triangles[at(triangles[i * triangles.size() / size])];
    const MovingTriangle triangle = {step.motion.path(v[0]), step.motion.path(v[1]),
                                     step.motion.path(v[2])};
    const ViewSign sign = view_sign(triangle, primitive, sample.rungs, Arithmetic::bounded);
    sample.positive += sign == ViewSign::positive;
    sample.negative += sign == ViewSign::negative;
  }
  return sample;
}

bool has_more_ghost_pairs(const GivenStep& step, const StepMarks& marks, double limit,
                          PacedStop& pace) {
  // The workers add up the pairs of their ghosts. None of them goes on when the sum is too large,
  // and whether it is depends on no order, although the sum that is then reached does.
  std::atomic<double> pairs = 0;
  constexpr std::uint64_t work_of_box = 10;
  constexpr std::size_t ghosts_of_piece = 1;  // because one may have the whole mesh in its box
  for (std::size_t c = 0; c < marks.primitives.size(); ++c) {
    if (marks.free[c]) continue;
    const auto ghosts = step.ghosts(c);
    const auto count_near = [&](std::size_t i, std::size_t, std::size_t) {
      SearchCounts counts;
      double sum = 0;
      const auto count = [&](std::int32_t) { return ++sum <= limit; };
      if (pairs.load() <= limit) {
        const auto box =
            step.tree.box_of_triangle(step.surface.all().triangles[at(ghosts[i])], step.motion);
        search_box(step.tree, box, counts, count);
      }
      if (sum > 0) pairs.fetch_add(sum);
      return work_of_box + counts.box_tests;
    };
    if (!for_all_counted(ghosts.size(), ghosts_of_piece, &pace, count_near)) return true;
    if (pairs.load() > limit) return true;
  }
  return false;
}

}  // namespace assay::detector
