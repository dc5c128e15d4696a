// Times several subjects on the same cases, side by side, and returns samples: the time of each
// round, the results and their hashes. A subject is the built-in detector in this process, by its
// options, or any detector in a worker. What is compared is measured in turn (interleave.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/formats/sequence_reader.h"
#include "detector/detector.h"
#include "detector/options.h"
#include "detector/step/stages.h"
#include "detector/step_result.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/bench_report.h"
#include "reports/bench/interleave.h"

namespace assay::reports {

// A hash of everything in a result that depends neither on time nor on the searches before the
// step (as the counts of marking do).
std::uint64_t result_hash(const detector::StepResult& result);

// One step of a detector that can be timed again and again, its result checked each time.
class TimedStep {
 public:
  // Commits all steps of `frames` but the last, which is the one to be timed. REQUIRES two frames
  // or more, which outlive this object. Throws UnusableData if the detector refuses the mesh.
  TimedStep(std::string name, const detector::Triangles& triangles,
            std::span<const detector::Positions> frames, const detector::Options& options,
            BenchReport& report);
  TimedStep(std::string name, const detector::Triangles& triangles,
            std::span<const detector::Positions> frames, const detector::Options& options,
            detector::Stages stages, BenchReport& report);

  // Evaluates the step once and returns the processor time in ns. A result that differs from the
  // first one is a wrong answer in the report.
  double time();
  // The result of the last evaluation. Evaluates the step once if there was none.
  const detector::StepResult& result();
  // The share of V+ among all triangles, leaving doubts aside.
  double positive_share();

 private:
  std::string name_;
  std::span<const detector::Positions> frames_;
  detector::Detector detector_;
  BenchReport& report_;
  detector::StepResult result_;
  std::uint64_t hash_ = 0;
  bool evaluated_ = false;
};

// The options of the benches: the caller vouches for the start, and all pairs are asked for.
detector::Options bench_options(detector::Culling culling,
                                detector::Arithmetic arithmetic = detector::Arithmetic::exact);

// The same for a sequence with this start, played with so many threads.
detector::Options options_of_sequence(detector::Culling culling, detector::Start start,
                                      std::uint32_t threads);

// The detector. Throws UnusableData, with this name, if the mesh was refused.
detector::Detector made(detector::Expected<detector::Detector> detector, const std::string& name);

// Two exact cullings that are asked for all pairs of one step must find the same. A difference in
// answers, pairs or their times is a wrong answer in the report.
void check_same_pairs(const std::string& name, const detector::StepResult& a,
                      const detector::StepResult& b, BenchReport& report);

// One subject at one step.
struct SweptStep {
  std::vector<double> ns;              // processor time of the step, one sample for each round
  std::vector<double> broad_phase_ns;  // of the same rounds
  detector::StepResult result;         // of the last evaluation
  std::uint64_t hash = 0;              // of that result (result_hash)
  bool differs = false;                // two evaluations gave different results
};

// Each subject carries its own state from step to step, as it would for a user. All of them
// evaluate each step rounds + 1 times in turn. Then `on_step` gets what they did, in the order of
// the subjects, and then the step is committed if the case says so. `tick` is called between
// evaluations. Throws UnusableData if a mesh is refused or a step is an error.
using OnStep = std::function<void(std::size_t step, std::span<const SweptStep> subjects)>;
void sweep_steps(
    const corpus::Case& c, std::span<const detector::Options> subjects, int rounds,
    const OnStep& on_step, const std::function<void()>& tick = [] {});

// One subject on a whole sequence.
struct SweptRun {
  std::vector<std::vector<double>> ns;        // [round][step]
  std::vector<detector::StepResult> results;  // of the round that is thrown away

  // For each round: the sum over its steps.
  std::vector<double> sums() const;
  // The times of one step, one for each round.
  std::vector<double> of_step(std::size_t step) const;
};

// The ratio over the rounds that both took part in.
Estimate ratio_in_common(const std::vector<double>& a, const std::vector<double>& b);

// In each round every subject makes a detector and plays all frames, which take `clock` (ns_of or
// wall_ns_of) a step. A first round is thrown away. A subject that took three times as long as the
// fastest one in that round takes part in the next two rounds alone, so it has fewer times than
// the others.
//
// If a subject's answers, pairs or times of contact differ from those of the first subject, the
// report counts a wrong answer. Runs with one culling must also agree in everything that
// result_hash() covers, whatever their threads.
using Clock = double(const std::function<void()>& work);
std::vector<SweptRun> sweep_runs(const std::string& name, const corpus::Sequence& sequence,
                                 std::span<const detector::Options> subjects, int rounds,
                                 Clock& clock, BenchReport& report);

// The runs of one case by one detector in a worker. The first run is judged.
struct WorkerRuns {
  std::optional<properties::CaseRun> first;
  std::vector<double> create_ms;  // without the first run, unless it is the only one
  std::vector<double> ms_a_step;  // as create_ms
  std::string ended;              // how a run ended that did not complete, in words
  bool is_once = false;           // the first run is the only one, and stands for every round
  bool has_differing_runs = false;
};

struct WorkerSubject {
  properties::WorkerProcess* worker;
  properties::Configuration configuration;  // is_timed is set
};

// Runs the case rounds + 1 times by each subject, in turn, a whole case each time. The times are
// those of the worker's own clock, with all of its threads. A subject does not run the case again
// after a run that did not complete, nor if its first run had a step of more than
// `longest_repeated` seconds; the samples of all rounds are then those of that run.
std::vector<WorkerRuns> sweep_workers(const corpus::Case& c,
                                      std::span<const WorkerSubject> subjects, int rounds,
                                      const std::function<void()>& tick,
                                      double longest_repeated = HUGE_VAL);

}  // namespace assay::reports
