// L10: a component by itself behaves as it does among others.
#pragma once

#include "properties/laws/law.h"

namespace assay::properties {

// Checks one component, chosen by the case's id, if there are two or more and all pairs are asked
// for (a collision of which only the first contacts are known makes all components dirty, L8).
void check_component_alone(CaseFacts& facts, LawTally& tally);

}  // namespace assay::properties
