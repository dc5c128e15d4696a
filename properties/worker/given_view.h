// Which view primitive a step of a case is given.
#pragma once

#include <optional>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/options.h"

namespace assay::properties {

// The primitive that the case states for the step (corpus::view_of_step), as the detector takes
// it; none if the case states none, or if the culling uses no views.
inline std::vector<detector::ViewPrimitive> given_view(
    std::optional<detector::ViewPrimitive> stated, detector::Culling culling) {
  if (!stated || !uses_views(culling)) return {};
  // A segment serves as a point by its first end.
  if (culling == detector::Culling::view_point) stated->q1 = stated->q0;
  return {*stated};
}

}  // namespace assay::properties
