// Draws a failing mesh as a small picture, for those who see only the log.
#pragma once

#include <string>

#include "reports/pictures/case_scene.h"

namespace assay::reports {

// SVG 1.1 without script, style sheet or background: an isometric projection of the mesh at the
// time of its contact, seen from the side that shows most of the failing pair. Triangles have the
// colours of their view sets; if the detector shows none, the two of the pair have a colour each,
// and the others are grey. The pair is outlined and numbered, ghosts are dashed, and the contact is
// a disc (exact) and a ring (the detector's): two of these and the segment between them where the
// nearest points are apart. `title` stands below, and the distance where one is asked for.
// O(n log n) in the triangles.
std::string mesh_svg(const CaseScene& scene, const std::string& title);

// The same contact as a strip of three such pictures from one side: where the step begins, where
// the two meet, where it ends. Dashes show the ways of the vertices that move. `title` is told to
// readers who do not see the picture. REQUIRES a step.
std::string strip_svg(const CaseScene& scene, const std::string& title);

}  // namespace assay::reports
