// What a campaign counts of a case besides its outcome: tags, set pairs of contacts, laws.
#pragma once

#include <span>

#include "properties/campaign/stored/record.h"
#include "properties/generators/draft.h"
#include "properties/laws/law.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// A law that a case breaks.
struct BrokenLaw {
  std::string law, configuration, explanation;
};

struct CaseTally {
  // The counts by the names of count_names.h: tags, contacts by the sets that the view-point sees,
  // laws.
  Counts counts;
  std::vector<BrokenLaw> broken;
};

// Counts one case. If `with_laws` is set, the laws are checked in each configuration that has view
// sets and asks for all pairs.
CaseTally tally_case(const GeneratedCase& made, std::span<const Configuration> configurations,
                     std::span<const CaseRun> runs, std::span<const oracle::StepJudgement> truth,
                     bool with_laws);

// The reducer's judge for a law, in a configuration of the built-in detector.
Judge judge_of_law(const Law& law, const Configuration& configuration);

}  // namespace assay::properties
