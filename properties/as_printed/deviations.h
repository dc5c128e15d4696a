// The thesis as printed: the detector with those stages that its text describes and that do not
// hold, all of them together and each alone.
//
// The stages that the text takes for granted stay right: the model starts free of collisions (the
// verified start), the primitive is inside (winding number 1), times and contacts are exact. The
// wrong stages are planted faults; here they are put together.
#pragma once

#include <span>
#include <string_view>

#include "properties/faults/fault.h"

namespace assay::properties {

struct Deviation {
  std::string_view name;
  std::string_view printed;  // what the text says
  std::string_view fault;    // the planted fault that does so, with its law and case
};

// In the order of the text.
std::span<const Deviation> deviations();

// The options of the scheme that the text ends with: a view-line, all pairs claimed.
inline constexpr detector::Options as_printed_options = {
    detector::Culling::view_line, detector::Start::verified, detector::Pairs::all};

// The stages with one deviation, and with all of them.
detector::Stages stages_with(const Deviation& deviation);
detector::Stages stages_as_printed();

}  // namespace assay::properties
