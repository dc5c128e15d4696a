// Claims that a run has not judged, and why. The verdict says nothing about them.
#pragma once

#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

struct NotJudged {
  std::string claim, reason;
};

// Those claims of a plug-in that were not judged, in their order. Its contract makes some void: a
// margin, no pairs. Others were never put to the test: no step had a contact; or its intervals of
// the first time were wider than 1e-3 in more than one of a hundred collisions, and so state no
// time. Empty for the built-in detector, whose contract is the default and whose times are
// enclosures.
std::vector<NotJudged> not_judged(const std::vector<std::string>& claims, const Contract& contract,
                                  const StepMeasures& measures);
std::vector<NotJudged> not_judged(const BoundDetector& detector, const StepMeasures& measures);
std::vector<NotJudged> not_judged(const RunFindings& findings);

// The names of the claims of a plug-in that were judged.
std::vector<std::string> judged_claims(const RunFindings& findings);

}  // namespace assay::properties
