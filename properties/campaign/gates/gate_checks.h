// What each gate looks at (gates.h says when it holds).
#pragma once

#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

// The lines that speak against a gate and, if there are none, the reason why it could not be
// judged, if there is one.
struct GateFindings {
  std::vector<std::string> against;
  std::string not_judged;
};

GateFindings check_harness(const RunFindings& findings, const Asked& asked);
GateFindings check_corpus(const RunFindings& findings, const Asked& asked);
GateFindings check_claims(const RunFindings& findings, const Asked& asked);
GateFindings check_complete(const RunFindings& findings, const Asked& asked);
GateFindings check_bounds(const RunFindings& findings, const Asked& asked);
GateFindings check_speed(const RunFindings& findings, const Asked& asked);

}  // namespace assay::properties
