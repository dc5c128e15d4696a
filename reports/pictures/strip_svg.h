// Draws a contact as a strip of three pictures: where the step begins, where the two meet, where it
// ends.
#pragma once

#include <string>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"

namespace assay::reports {

// SVG without script or background, for light and dark grounds: its colours follow the reader's
// scheme. The two triangles of the contact have a colour each and all others are grey; where the
// two pierce each other, what they share is a red line. Dashes show the ways of the vertices that
// move. All three are seen from the same side, the one that shows most of both triangles. `title`
// is told to readers who do not see the picture. O(n log n) in the triangles.
std::string strip_svg(const corpus::Case& c, const corpus::CaseStep& step,
                      const detector::PairContact& contact, const std::string& title);

}  // namespace assay::reports
