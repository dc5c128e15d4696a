// One step of a detector that can be timed again and again, its result checked each time.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "corpus/formats/mesh_reader.h"
#include "detector/detector.h"
#include "detector/step/stages.h"
#include "reports/bench/bench_report.h"

namespace assay::reports {

// Of everything in a result that does not depend on time, or on the searches before the step (as
// the marking counts do).
std::uint64_t result_hash(const detector::StepResult& result);

class TimedStep {
 public:
  // Commits all steps of `frames` but the last, which is the one to be timed. frames: two or more,
  // must outlive this object. Throws UnusableData where the detector refuses the mesh.
  TimedStep(std::string name, const detector::Triangles& triangles,
            std::span<const detector::Positions> frames, const detector::Options& options,
            BenchReport& report);
  TimedStep(std::string name, const detector::Triangles& triangles,
            std::span<const detector::Positions> frames, const detector::Options& options,
            detector::Stages stages, BenchReport& report);

  // Processor time of one evaluation in ns. A result that differs from the first is a wrong answer
  // in the report.
  double time();
  // Of the last evaluation; evaluates once when there was none.
  const detector::StepResult& result();
  // V+ over all triangles, doubt aside.
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

// How the benches ask: the caller vouches for the start, all pairs.
detector::Options bench_options(detector::Culling culling,
                                detector::Arithmetic arithmetic = detector::Arithmetic::exact);

// A scene of corpus/; the names and sizes are those of the benches, so it cannot fail.
corpus::Sequence bench_scene(const std::string& name, int triangles, int frames);

}  // namespace assay::reports
