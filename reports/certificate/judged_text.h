// What a verdict is about, for people: a certificate says no more than what was claimed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::reports {

// What a predicate is about: "claims free-sound, total; not judged: no-spurious (the contract has
// a margin), its elementary query; meshes of up to 2048 triangles; contract margin 0.1; isolation
// full; campaign smoke, seed 1 (the default)". For the built-in detector, whose configurations
// differ in their claims, the number of configurations stands there instead.
std::string judged_text(const nlohmann::ordered_json& predicate);

}  // namespace assay::reports
