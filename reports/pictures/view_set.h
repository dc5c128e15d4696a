// View sets under the names that pages and pictures show, and their colours.
#pragma once

#include <array>
#include <cstdint>

#include "detector/mesh/step_types.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::reports {

// The view set of a triangle over a step. A triangle in doubt (dirty, violated) is in that set
// whatever its sign is, as in the search for pairs.
enum class ViewSet : std::uint8_t { none, positive, negative, zero, dirty, violated };

// Names and colours in the order of ViewSet. The colours are mid-tones for light and dark grounds
// alike, which people who see colours differently can tell apart (Okabe and Ito).
inline constexpr std::array<const char*, 6> view_set_names = {"none", "V+",    "V-",
                                                              "V0",   "dirty", "violated"};
inline constexpr std::array<const char*, 6> view_set_colours = {"#9aa0a6", "#56b4e9", "#e69f00",
                                                                "#f0e442", "#cc79a7", "#d55e00"};

// The set of a triangle; `none` if the step has no view sets. A triangle that is both touched by a
// ghost and dirty counts as violated.
inline ViewSet view_set(const detector::StepResult& result, std::size_t triangle) {
  if (triangle >= result.signs.size()) return ViewSet::none;
  const std::uint8_t doubt = triangle < result.doubts.size() ? result.doubts[triangle] : 0;
  if (doubt & detector::doubt::violated) return ViewSet::violated;
  if (doubt & detector::doubt::dirty) return ViewSet::dirty;
  const auto sign = result.signs[triangle];
  return sign == detector::ViewSign::positive   ? ViewSet::positive
         : sign == detector::ViewSign::negative ? ViewSet::negative
                                                : ViewSet::zero;
}

}  // namespace assay::reports
