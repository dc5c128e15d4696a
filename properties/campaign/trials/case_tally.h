// What a campaign counts of a case besides its outcome: tags, set pairs of contacts, laws.
#pragma once

#include <span>
#include <string>
#include <vector>

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

// A case that was run in some configurations and judged.
struct RunCase {
  const GeneratedCase& made;
  std::span<const Configuration> configurations;
  std::span<const CaseRun> runs;
  std::span<const oracle::StepJudgement> truth;
  bool with_laws = true;
};

// Counts each of the cases. If `with_laws` is set, the laws are checked in each configuration that
// has view sets and asks for all pairs; those of all cases together, in one copy of this process
// (law_checks.h).
std::vector<CaseTally> tally_cases(std::span<const RunCase> cases);

// The reducer's judge for a law, in a configuration of the built-in detector.
Judge judge_of_law(const Law& law, const Configuration& configuration);

}  // namespace assay::properties
