#include "detector/step/step_input.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/step_types.h"
#include "detector/step_result.h"

namespace assay::detector {

std::optional<Problem> check_step_input(const Surface& surface, const PositionsView& x_t0,
                                        const PositionsView& x_t1,
                                        std::span<const ViewPrimitive> primitives) {
  for (const auto* x : {&x_t0, &x_t1}) {
    if (auto problem = check_positions(*x, surface.first_apex)) return problem;
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
