// Runs planted faults on cases: one of the corpus alone, judged by the oracle; and the thesis as
// printed, put together from such faults: what it misses and saves over random cases of the
// campaigns' generic families.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/faults/fault.h"
#include "properties/judging/agreement.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// Runs the case's script through a detector of these stages, and returns one result for each step.
// The case's own view primitive is used if the culling uses views. If the mesh is refused, every
// step has the answer `error`.
std::vector<detector::StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                           const detector::Stages& stages);
std::vector<detector::StepResult> run_case(const corpus::Case& c, const Fault& fault);

// Runs the case in the same way, but disturbed. Each step is first evaluated with a stop: at the
// first time that the detector asks, then at the second and so on; after each stopped evaluation
// it is evaluated whole. Then it is taken while a second detector of the same stages works on the
// same step in between. A right detector gives the same results as undisturbed, because undecided
// evaluations change nothing and two detectors share nothing. One result is returned for each
// step: one that differs from `undisturbed`, if there is one.
using MakeStages = detector::Stages (*)(const detector::Options&);
std::vector<detector::StepResult> run_disturbed(const corpus::Case& c,
                                                const detector::Options& options, MakeStages stages,
                                                std::span<const detector::StepResult> undisturbed);
// The results as a run that can be compared with another: without the counts of marking, because
// these depend on the marking before, whether its step was committed or not.
CaseRun without_marking_counts(std::vector<detector::StepResult> results);

// The thesis as printed: the detector with those stages that its text describes and that do not
// hold, all of them together and each alone.
//
// The stages that the text takes for granted stay right: the model starts free of collisions (the
// verified start), the primitive is inside (winding number 1), times and contacts are exact. The
// wrong stages are planted faults; here they are put together.

struct Deviation {
  std::string_view name;
  std::string_view printed;  // what the text says
  std::string_view fault;    // the planted fault that does so, with its law and case
};

// In the order of the text.
std::span<const Deviation> deviations();

// The options of the scheme that the text ends with: a view-line, all pairs claimed.
inline constexpr detector::Options as_printed_options = {
    detector::Culling::view_line, detector::Start::verified, detector::Pairs::all};

// The stages with one deviation, and with all of them.
detector::Stages stages_with(const Deviation& deviation);
detector::Stages stages_as_printed();

// One detector over all steps. A missed step is counted once, under the worst that befell it.
struct TollRow {
  std::string name;
  std::uint64_t silent = 0;      // answered free, although there is a contact
  std::uint64_t late = 0;        // answered collision with a late first time
  std::uint64_t incomplete = 0;  // the first time is right, but pairs are missing
  std::uint64_t pairs_missing = 0;
  std::uint64_t candidates = 0;
  // Milliseconds of the steps without their view tests, because a deviation computes its own in
  // exact numbers. Not deterministic.
  double ms = 0;
};

struct TollTable {
  std::uint64_t cases = 0, steps = 0, colliding = 0, pairs = 0;  // counted by the oracle
  std::vector<TollRow> rows;  // the right detector, each deviation alone, all of them together
};

// Runs the cases campaign:family:0, 1, ... of each generic family. About 30 ms a case.
TollTable measure_toll(const std::string& campaign, std::uint64_t cases_of_family);

// A table, a line a row.
std::string text_of(const TollTable& table);

}  // namespace assay::properties
