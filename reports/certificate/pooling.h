// Takes several nights of one detector together.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "properties/problem.h"

namespace assay::reports {

// Adds up the strata of certificates (their predicates), with the bounds of the sums: a list of
// {family, configuration, n, holds, bound}.
//
// another_run unless all speak of one detector, generator and judge: equal digests of program,
// worker, plug-in and generator, equal detector, families and bounds. A fixed bug is another
// program, and starts at 0. wrong_shards if a trial would count twice: campaign and seed must
// differ between any two.
properties::Expected<nlohmann::ordered_json> pool(
    const std::vector<nlohmann::ordered_json>& predicates);

}  // namespace assay::reports
