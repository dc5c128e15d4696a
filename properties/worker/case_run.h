// Runs one case through one configuration of a detector: every step of its script, with the state
// carried from step to step.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "detector/detector.h"
#include "detector/step/stages.h"
#include "properties/words.h"

namespace assay::properties {

// The built-in detector with these options. For a plug-in only the name and is_timed are used.
struct Configuration {
  std::string name;
  Options options;
  std::string fault = {};  // the fault to plant in the detector (faults/fault.h), or empty
  bool is_timed = false;   // whether the run measures CaseRun::times
  // Whether the detector is also asked, before each step, how far the step may go
  // (CaseRun::limits).
  bool asks_limits = false;
};

// Processor seconds and memory of the process that ran a case, with all of its threads. The process
// itself states these numbers, so a plug-in, which runs in that process, could forge them. They are
// only for benches, and no verdict depends on them.
struct RunTimes {
  double create = 0;
  std::vector<double> steps;  // for each step the time until its answer, commit included
  // The highest resident memory of that process since it began; 0 if unknown.
  std::uint64_t peak_bytes = 0;
};

enum class RunEnd : std::uint8_t {
  completed,        // every step has a result, which may be undecided or an error
  crashed,          // the process ended while the detector ran
  hung,             // stopped at a time limit: undecided
  refused,          // the mesh was refused, with a named error, when the detector was made
  out_of_memory,    // the memory was used up before the first step: undecided
  not_run,          // there is no worker for the case: the harness failed, not the detector
  beyond_capacity,  // the mesh was refused for its size when the detector was made
};
constexpr auto names_of(RunEnd) {
  using enum RunEnd;
  return std::to_array<Named<RunEnd>>({{completed, "completed"},
                                       {crashed, "crashed"},
                                       {hung, "hung"},
                                       {refused, "refused"},
                                       {out_of_memory, "out of memory"},
                                       {not_run, "not run"},
                                       {beyond_capacity, "refused: capacity"}});
}

// The candidate pairs of one step; nothing if the detector failed to give them.
using CandidatePairs = std::optional<std::vector<TrianglePair>>;

// How far a limiter lets the caller go in one step (L17).
struct LimitAnswer {
  double share = -1;    // the share of the step; -1: not stated
  Positions positions;  // the positions at which the caller stops
};

struct CaseRun {
  RunEnd end = RunEnd::completed;
  // One line: the signal, the refusal, or the first error of a step. Empty if every step has an
  // answer.
  std::string explanation;
  // If the run completed, one result for each step of the case; otherwise empty. A first time that
  // a plug-in does not state, of the step or of a pair, is [0, 1].
  std::vector<StepResult> steps;
  // Only for a plug-in that claims candidates: one list for each step, ascending, each pair once.
  std::vector<CandidatePairs> candidates = {};
  // Only from a limiter, if limits are asked for: its answer to each step; nothing if it failed.
  std::vector<std::optional<LimitAnswer>> limits = {};
  // For each step why it has no answer ("step 2: ..."), or an empty text if it has an answer. The
  // list is empty if all steps have answers.
  std::vector<std::string> errors = {};
  // For each step whether a plug-in refused the step as beyond its capacity; the answer of such a
  // step is an error. The list is empty if the plug-in refused no step.
  std::vector<std::uint8_t> over_capacity = {};
  // Whether the detector answers steps at all. A library that only lists candidates answers none:
  // each of its steps is stored as undecided, or, if the library failed, as an error.
  bool has_answers = true;
  // Only if the run completed and its configuration asks for times.
  std::optional<RunTimes> times = {};

  // The members below are the circumstances of the run. The host sets these members. same_answers()
  // ignores them, and ignores `times`.
  //
  // How often the worker was killed from outside during this run (which was then repeated), or
  // before it began.
  std::uint64_t disturbances = 0;
  // The processor time of the last attempt: of the worker with its threads and, if the run was long
  // enough to measure them, of the processes that the worker started (child_process.h).
  double processor_seconds = 0;
  // The last lines that a plug-in printed since the reply to the run before this one (isolation.h).
  // If cases were sent together, the lines may be those of a later case. Empty for the built-in
  // detector.
  std::string output = {};
};

// Runs the case in this process, so that a crash of the detector ends the caller. Steps that commit
// advance the state. The detector is given the case's view primitive if its culling uses views (for
// view-point only the primitive's q0). A step that runs out of memory is undecided.
CaseRun run_case(const Case& c, const Configuration& configuration);

// Runs the case like run_case, with disturbances. Each step is first evaluated several times with a
// stop: at the first call of the stop function, then at the second call, and so on. After each
// stopped evaluation the step is evaluated completely. Then the step is played while a second
// detector of the same stages works on the same step in between. A right detector gives the same
// results as without disturbances, because undecided evaluations change nothing and two detectors
// share nothing. Returns one result for each step. If some evaluation of a step had a result other
// than `undisturbed`, returns such a result for this step. REQUIRES a mesh that is not refused.
std::vector<StepResult> run_disturbed(const Case& c, const Configuration& configuration,
                                      std::span<const StepResult> undisturbed);
// Returns the results as a run, to be compared with other runs. The counts of marking are removed,
// because they depend on the marking of the evaluation before, even if that evaluation was not
// committed.
CaseRun without_marking_counts(std::vector<StepResult> results);

// Adds the text to the errors of step s. If `explanation` is empty, the text also becomes the
// explanation.
void note_error(CaseRun& run, std::size_t s, const std::string& text);
// Returns why step s has no answer; empty if no reason is known.
std::string error_of(const CaseRun& run, std::size_t s);

// note_capacity records that step s was refused as beyond the capacity. is_over_capacity returns
// whether this was recorded.
void note_capacity(CaseRun& run, std::size_t s);
bool is_over_capacity(const CaseRun& run, std::size_t s);

// Returns the run to report for a case that did not fit into memory.
CaseRun out_of_memory();

// Returns whether two runs of one case agree in everything but times and circumstances.
bool same_answers(const CaseRun& a, const CaseRun& b);

// Measures the cost of a case in the process that runs it, part by part: the processor time of this
// process with all of its threads, and its memory. Measures nothing if `is_on` is false.
class RunClock {
 public:
  // Begins to time the making of the detector.
  explicit RunClock(bool is_on) : is_on_(is_on) { begin(); }
  void created() { times_.create = lap(); }
  void begin() { lap(); }  // a step begins
  // Notes that the step that began last has its answer.
  void end_step() { times_.steps.push_back(lap()); }
  std::optional<RunTimes> take();

 private:
  double lap();

  bool is_on_;
  double last_ = 0;
  RunTimes times_;
};

// Plays a case through the built-in detector, which carries its state from step to step.

// Returns the primitive that the case states for the step (corpus::view_of_step), in the form for
// the detector. Returns no primitive if the case states none, or if the culling uses no views. The
// function is inline because tests/mutation links only the detector.
inline std::vector<ViewPrimitive> given_view(std::optional<ViewPrimitive> view, Culling culling) {
  if (!view || !uses_views(culling)) return {};
  // If the case states a segment, view-point takes its first end.
  if (culling == Culling::view_point) view->q1 = view->q0;
  return {*view};
}

class CasePlayer {
 public:
  // Makes a new detector from the first frame, with these stages or the standard stages. The
  // relation of the case replaces the relation of the options. The case must outlive the player.
  // Errors and cost are as for Detector::create.
  static detector::Expected<CasePlayer> make(const Case& c, const Options& options,
                                             std::optional<detector::Stages> stages = {},
                                             const StopFunction& stop = {});

  // Returns the number of steps of the case. All functions below REQUIRE s < steps().
  std::size_t steps() const { return script_.size(); }
  const CaseStep& step(std::size_t s) const { return script_[s]; }
  const Positions& x_t0(std::size_t s) const { return start_of(*case_, script_[s]); }
  const Positions& x_t1(std::size_t s) const { return end_of(*case_, script_[s]); }

  // Plays step s as the script says: the state advances if the script commits the step and the step
  // has an answer. Steps may be played in any order; a step that does not continue the detector's
  // state is a new start for the detector.
  StepResult play(std::size_t s, const StopFunction& stop = {});
  // Returns the result that play() would return, but does not advance the state. Afterwards
  // detector().commit() can advance the state.
  StepResult look(std::size_t s, const StopFunction& stop = {});

  detector::Detector& detector() { return detector_; }
  const detector::Detector& detector() const { return detector_; }

 private:
  CasePlayer(const Case& c, const Options& options, detector::Detector detector);

  const Case* case_;
  std::vector<CaseStep> script_;
  // For each step the view primitives given to the detector. They are computed beforehand, so that
  // only the detector's own work takes time in a step.
  std::vector<std::vector<ViewPrimitive>> views_;
  detector::Detector detector_;
};

}  // namespace assay::properties
