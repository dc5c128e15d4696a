#include "detector/step/step_input.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/step_types.h"
#include "detector/parallel/for_all.h"
#include "detector/step_result.h"

namespace assay::detector {

namespace {

// Whether check_positions would find nothing. The workers share the rows, because no row has to be
// named here.
bool is_whole(const PositionsView& x, Eigen::Index vertex_count, const PacedStop& pace) {
  if (x.rows() != vertex_count) return false;
  std::atomic<bool> found_nothing = true;
  PacedStop unasked = pace.unasked();
  for_all_pieces(static_cast<std::size_t>(x.rows()), rows_of_piece, 0, &unasked,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   const auto first = static_cast<Eigen::Index>(begin),
                              count = static_cast<Eigen::Index>(end - begin);
                   if (check_positions(x.middleRows(first, count), count)) found_nothing = false;
                 });
  return found_nothing;
}

}  // namespace

std::optional<Problem> check_step_input(const Surface& surface, const SteppedMesh& motion,
                                        std::span<const ViewPrimitive> primitives,
                                        PacedStop& pace) {
  for (const auto* x : {&motion.vertices_t0, &motion.vertices_t1}) {
    if (!is_whole(*x, surface.first_apex, pace)) return check_positions(*x, surface.first_apex);
  }
  const auto components = surface.mesh.components.size();
  if (primitives.size() > 1 && primitives.size() != components) {
    return Problem{InputError::wrong_primitive_count,
                   std::to_string(primitives.size()) + " view primitives for " +
                       std::to_string(components) + " components"};
  }
  for (const auto& primitive : primitives) {
    for (const auto* point :
         {&primitive.q0.t0, &primitive.q0.t1, &primitive.q1.t0, &primitive.q1.t1}) {
      if (!std::all_of(point->begin(), point->end(), [](double c) { return std::isfinite(c); })) {
        return Problem{InputError::non_finite_coordinate, "a view primitive is not finite"};
      }
    }
  }
  return std::nullopt;
}

StepResult refused(Problem problem) {
  StepResult result;
  result.answer = Answer::error;
  result.problem = std::move(problem);
  return result;
}

}  // namespace assay::detector
