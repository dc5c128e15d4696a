// The scene of a case in `assay-report/2`: what the viewer draws.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/pictures/case_scene.h"

namespace assay::reports {

// Fields: reports/README.md, `scene`.
nlohmann::ordered_json scene_json(const CaseScene& scene);

}  // namespace assay::reports
