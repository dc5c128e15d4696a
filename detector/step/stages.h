// The stages from which a detector is assembled. Each stage can be replaced.
//
// The production detector with its cullings is assembled from the standard stages. For another
// scheme, or a scheme that is wrong on purpose, derive a class from the stage that differs, and
// assemble it with the standard stages for the rest (assembly.h).
#pragma once

#include <memory>

#include "detector/boundary/boundary_handler.h"
#include "detector/search/candidate_search.h"
#include "detector/step/release_rule.h"
#include "detector/view/view_signs.h"

namespace assay::detector {

struct Stages {
  std::shared_ptr<const ViewClassifier> classifier;
  std::shared_ptr<const BoundaryHandler> boundary;
  std::shared_ptr<const PairRule> pair_rule;
  std::shared_ptr<const Marking> marking;
  std::shared_ptr<const PairSearch> pair_search;
  std::shared_ptr<const ElementaryTest> elementary;
  std::shared_ptr<const ReleaseRule> release;
};

// Returns the standard stages for these options.
Stages standard_stages(const Options& options);

}  // namespace assay::detector
