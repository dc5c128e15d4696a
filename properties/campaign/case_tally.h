// What a campaign counts of a case besides its verdict: tags, set pairs of contacts, laws.
#pragma once

#include <span>

#include "properties/campaign/record.h"
#include "properties/generators/generated_case.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// "tag:NAME": 1 for each tag. "block:NAME", "first:NAME": contacts, and first contacts, by the view
// sets of their two triangles, seen from the view-point. With laws, for each configuration that
// has view sets and asks for all pairs, "law:NAME/premise", "/close", "/broken" (law.h).
Counts tally_case(const GeneratedCase& made, std::span<const Configuration> configurations,
                  std::span<const CaseRun> runs, std::span<const oracle::StepJudgement> truth,
                  bool with_laws);

}  // namespace assay::properties
