// What a campaign counts of a case besides its outcome: how far it goes, tags, set pairs of
// contacts, and laws, of the built-in detector and of a plug-in.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/step.h"
#include "properties/campaign/ledger/record.h"
#include "properties/judging/trial.h"
#include "properties/laws/law.h"
#include "properties/laws/metamorphic/change_laws.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/case_run.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

struct GeneratedCase;

// How far the cases go on which a detector is tried. Beyond that nothing is known of it.

// The extremes of a case whose steps the oracle judged so. Costs O(N + M), and compares each frame
// with one other. REQUIRES triangles of which a detector can be made.
Extremes extremes_of(const corpus::Case& c, std::span<const oracle::StepJudgement> truth);

// The places in steps_of(c) of the steps that do not go on from a committed one.
std::vector<std::size_t> new_starts(const corpus::Case& c);

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

// Puts a case to a plug-in in other forms (changes/changes.h), and judges what it answers.
//
// A law of a plug-in is broken if a claim holds in the case and not in its form: the form is judged
// by the oracle like any case. A detector that claims to be deterministic breaks it also by other
// answers to the same calls. Other answers that its claims allow are counted alone: an interval of
// time may be wider in one form, and a collision may be a false alarm in one form.

struct FormCheck {
  // Premise and differs are steps, and broken is 0 or 1; nothing if the form did not apply.
  LawCount count;
  std::optional<StoredFailure> failure;  // of the form, if the law is broken
  std::uint64_t disturbances = 0;
};

// Runs the form of a case in the worker. Nothing is judged if it does not apply, if the contract
// leaves some of its steps out, or if it runs out of time or memory. `run` is the run of the case.
// Throws StoreProblem if there is no worker. REQUIRES a contracted case of meshes in which all
// pairs count, and whose run holds, and a law about a change of such.
FormCheck check_in_form(const Law& law, const corpus::Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker);

// Whether cases of this detector are put to it in other forms, and this is such a case.
bool has_forms(const DetectorUnderTest& detector, const corpus::Case& c);

}  // namespace assay::properties
