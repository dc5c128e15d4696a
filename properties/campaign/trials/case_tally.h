// What a campaign counts of a case besides its outcome: tags, set pairs of contacts, laws.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "properties/campaign/ledger/record.h"
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
  TrialCounts counts;
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
// (check_in_copies).
std::vector<CaseTally> tally_cases(std::span<const RunCase> cases);

// The reducer's judge for a law, in a configuration of the built-in detector.
Judge judge_of_law(const Law& law, const Configuration& configuration);

// Checks laws where a crash of the detector does no harm. A law runs the built-in detector again,
// in this program; if that crashes, the law is broken, and all other checks go on.

// Runs check(0) to check(count - 1), in this order, in a copy of this process. A check that ends
// the copy is broken: its tally says how the copy ended, and the next check begins a new copy. So
// whatever `check` keeps from one call to the next, it must be able to make again.
// case_of(i) is the id of the case that check i is about, for the words of a tally. Throws what
// `check` throws, and std::runtime_error if copies are killed from outside again and again. A copy
// costs some ten milliseconds, mostly for pages that both processes write, so whoever has many
// cases checks them together.
std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check);

}  // namespace assay::properties
