// Adds up what several certificates of one detector say, such as those of several nights.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "properties/problem.h"

namespace assay::reports {

// Takes the member "predicate" of each certificate and adds up their strata. The result is a list
// of {family, configuration, n, holds, bound}: of n trials so many hold, and `bound` is the upper
// bound of the rate of failures at the confidence of the campaigns.
//
// Fails unless all certificates speak of one detector, generator and judge: the
// digests of program, worker, plug-in and generator must be equal, and so must detector, families
// and the number of bounds. A program in which a bug was fixed is another program, so its sums
// start at 0. It fails too if a trial would count twice: no two certificates may have
// the same campaign and the same seed.
properties::Expected<nlohmann::ordered_json> pool(
    const std::vector<nlohmann::ordered_json>& predicates);

}  // namespace assay::reports
