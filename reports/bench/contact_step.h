// Steps with contacts that mean the same at every mesh size.
#pragma once

#include <optional>
#include <string>

#include "corpus/formats/sequence_reader.h"

namespace assay::reports {

// Two frames of a scene around its first contact: the fastest vertex moves by the mean length of
// an edge, and the first contact is in the middle. On a fine mesh a step between frames of the
// scene itself would be many edges long, and its pairs would grow faster than the mesh. Nothing if
// the scene has no contact.
std::optional<corpus::Sequence> step_at_first_contact(const std::string& scene, int triangles);

}  // namespace assay::reports
