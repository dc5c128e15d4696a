// One case through one configuration of a detector: every step of its script, state carried.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::properties {

// The built-in detector with these options; of a plug-in only the name is used.
struct Configuration {
  std::string name;
  detector::Options options;
  std::string fault = {};  // the planted fault to plant in it (faults/fault.h), or empty
  bool is_timed = false;   // whether CaseRun::times is asked for
};

// Processor seconds of the process that ran a case, with all of its threads, by its own clock: for
// benches. A plug-in shares that process and could say what it likes, so nothing is judged by it.
struct RunTimes {
  double create = 0;
  std::vector<double> steps;  // one for each: to its answer, and committed where the script says so
  // Resident memory of that process at its highest, since it began; 0 where the system tells none.
  std::uint64_t peak_bytes = 0;
};

enum class RunEnd : std::uint8_t {
  completed,      // every step has a result, which may be undecided or an error
  crashed,        // the process ended under the detector
  hung,           // stopped at a time limit: undecided
  refused,        // the mesh was refused by name when the detector was made
  out_of_memory,  // before the first step: undecided
  not_run,        // there is no worker to run it: the harness failed, not the detector
};

const char* name_of(RunEnd end);

// Nothing where a detector failed to give them.
using CandidatePairs = std::optional<std::vector<detector::TrianglePair>>;

struct CaseRun {
  RunEnd end = RunEnd::completed;
  // One line: the signal, the refusal, or the first step's error. Empty when nothing is wrong.
  std::string what;
  // One for each step of the case when completed, else none. A pair or first time that a plug-in
  // does not state is [0, 1].
  std::vector<detector::StepResult> steps;
  // One for each step, of a plug-in that claims candidates: ascending, each pair once.
  std::vector<CandidatePairs> candidates = {};
  // Why a step has no answer, "step 2: ..."; empty for one that has, and no list where all have.
  std::vector<std::string> errors = {};
  // Whether its steps have answers. A library of candidates alone has none: a step of its is
  // undecided, or an error.
  bool has_answers = true;
  // Of a completed run that was asked for it.
  std::optional<RunTimes> times = {};

  // Of the circumstances, filled in by the host; same_answers() looks neither at them nor at times.

  // How often the worker was killed from outside while this run was under way, which was then
  // repeated, or before it began.
  std::uint64_t disturbances = 0;
  // What it took: processor time of the worker with its threads, and with the processes that it
  // started where the run was long enough to look at them (processor_time.h). Of the last attempt.
  double processor_seconds = 0;
  // What a plug-in printed meanwhile, the last lines of it (isolation/printed_words.h); nothing
  // with isolation none, nor of a query that was asked together with others.
  std::string printed = {};
};

// Steps of the case that commit advance the state. The case's view primitive is given where the
// culling is one of views (its q0 alone for view-point). A step that runs out of memory is
// undecided. Runs in this process: what the detector does to it, it does to the caller.
CaseRun run_case(const corpus::Case& c, const Configuration& configuration);

// Adds to the errors of step s, and to `what` where that says nothing yet.
void note_error(CaseRun& run, std::size_t s, const std::string& what);
// Why step s has no answer; empty where nothing is said of it.
std::string error_of(const CaseRun& run, std::size_t s);

// The run of a case that did not fit into memory.
CaseRun out_of_memory();

// Whether two runs of one case gave the same: all but times and circumstances.
bool same_answers(const CaseRun& a, const CaseRun& b);

}  // namespace assay::properties
