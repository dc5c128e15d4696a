// Times several subjects on the same case, side by side, and returns what they answered and the
// times of each round. A subject is the built-in detector in this process, by its options, or any
// detector in a worker. What is compared is measured in turn.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/step/stages.h"
#include "detector/step_result.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

// The processor time of this thread in one run of `work`, in ns. The work of other programs does
// not count, but their effect on caches and clock rates remains.
double ns_of(const std::function<void()>& work);
// The same by the clock on the wall, for work in several threads.
double wall_ns_of(const std::function<void()>& work);

// The hash FNV-1a, over 64-bit words.
inline constexpr std::uint64_t first_hash = 0xcbf29ce484222325u;
constexpr std::uint64_t hashed(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ word) * 0x100000001b3u;
}

// A hash of everything in a result that depends neither on time nor on the searches before the
// step (as the counts of marking do).
std::uint64_t result_hash(const detector::StepResult& result);

// How a case is played and timed.
using Clock = double(const std::function<void()>& work);  // ns_of, wall_ns_of

// The stages of a detector in this process; a test may replace some.
using MakeStages = std::function<detector::Stages(const detector::Options&)>;

struct SweptSubject {
  properties::WorkerProcess* worker = nullptr;    // null: the built-in detector in this process
  properties::Configuration configuration;        // is_timed is set
  MakeStages stages = detector::standard_stages;  // in this process
};

struct SweepPlan {
  int rounds = 2;
  Clock* clock = ns_of;  // of subjects in this process
  // Subjects in this process look at each step once before it is timed, so that a short case does
  // not show what new memory costs.
  bool is_warm = false;
  // A subject whose first run had a step of more seconds is not run again. The samples of all
  // rounds are then those of that run.
  double longest_repeated = HUGE_VAL;
  // A subject that took so many times as long as the fastest one takes part in two rounds alone.
  double far_off = HUGE_VAL;
  std::function<void()> tick = [] {};  // called between runs
};

// The runs of one case by one subject.
struct SweptRuns {
  std::optional<properties::CaseRun> first;   // the one that is judged
  std::vector<properties::RunTimes> samples;  // of each round, without the first run
  std::string ended;                          // how a run ended that did not complete, in words
  bool is_once = false;  // the first run is the only one, and stands for every round
  bool has_differing_runs = false;

  // In ms, one for each round.
  std::vector<double> sums() const;
  std::vector<double> of_step(std::size_t step) const;
  std::vector<double> create_ms() const;
};

// Runs the case rounds + 1 times by each subject, in turn, a whole case each time: forward, and
// then forward and backward by turns, so that what is compared was measured side by side. The first
// round is judged and not timed. The times of a worker are those of its own clock, with all of its
// threads. A subject whose run did not complete is not run again. Throws UnusableData if the
// detector in this process refuses the mesh, or a step of it is an error.
std::vector<SweptRuns> sweep(const corpus::Case& c, std::span<const SweptSubject> subjects,
                             const SweepPlan& plan);

}  // namespace assay::reports
