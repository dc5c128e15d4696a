// Makes the detector's own choice of a view primitive part of the case.
#pragma once

#include <optional>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "properties/campaign/trials/trial.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

// The same case with the primitive of its first component stated. Nothing if the culling has no
// views, if the case states a primitive already, or if the mesh is refused.
std::optional<corpus::Case> with_explicit_view(const corpus::Case& c,
                                               const detector::Options& options);

// The finding for which the reducer keeps a failure.
Finding finding_of(const Failure& failure);

}  // namespace assay::properties
