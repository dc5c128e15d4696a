// A failing mesh as a small picture, for those who see only the log.
#pragma once

#include <string>

#include "reports/pictures/case_scene.h"

namespace assay::reports {

// SVG 1.1, no script, no style sheet, no ground: an isometric projection of the mesh at the time of
// its contact, seen from the side that shows most of the failing pair. Triangles in the colours of
// their view sets, the pair outlined and numbered, ghosts dashed, the contact a disc (exact) and a
// ring (the detector's). `title` stands below. O(n log n) in the triangles.
std::string mesh_svg(const CaseScene& scene, const std::string& title);

}  // namespace assay::reports
