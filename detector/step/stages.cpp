#include "detector/step/stages.h"

#include "detector/distance/nearness.h"
#include "detector/traditional/traditional.h"

namespace assay::detector {

Stages standard_stages(const Options& options) {
  const Culling culling = options.culling;
  Stages stages;
  stages.classifier = std::make_shared<ViewClassifier>(options.arithmetic);
  stages.boundary = std::make_shared<BoundaryHandler>();
  stages.pair_rule =
      uses_views(culling) ? std::make_shared<PairRule>() : std::make_shared<EveryPair>();
  stages.marking = std::make_shared<Marking>();
  if (culling == Culling::none) {
    stages.pair_search = std::make_shared<ExhaustiveSearch>();
  } else if (culling == Culling::normal_cone) {
    stages.pair_search = std::make_shared<NormalConeSearch>();
  } else if (culling == Culling::automatic) {
    stages.pair_search =
        std::make_shared<NormalConeSearch>(NormalConeSearch::Scope::of_four_triangles_or_more);
  } else {
    stages.pair_search = std::make_shared<WideSearch>();
  }
  stages.elementary = options.separation > 0 ? make_near_test(options.separation)
                                             : make_elementary_test(options.arithmetic);
  stages.release = std::make_shared<ReleaseRule>(options.arithmetic);
  return stages;
}

}  // namespace assay::detector
