// The stages that a detector is assembled from, each replaceable.
//
// The standard stages make the production detector and its cullings. Another scheme, or a scheme
// that is wrong on purpose, is made by deriving from the stage that it changes and assembling that
// with the others (assembly.h).
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

// Returns the stages that these options ask for.
Stages standard_stages(const Options& options);

}  // namespace assay::detector
