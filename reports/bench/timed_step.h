// One step of a detector that can be timed again and again, its result checked each time.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "corpus/formats/sequence_reader.h"
#include "detector/detector.h"
#include "detector/options.h"
#include "detector/step/stages.h"
#include "detector/step_result.h"
#include "reports/bench/bench_report.h"

namespace assay::reports {

// A hash of everything in a result that depends neither on time nor on the searches before the
// step (as the counts of marking do).
std::uint64_t result_hash(const detector::StepResult& result);

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

}  // namespace assay::reports
