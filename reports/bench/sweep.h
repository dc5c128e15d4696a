// Times several subjects on the same case, side by side, and returns their answers and the times of
// each round. A subject is either the built-in detector in this process, with given options, or any
// detector in a worker. Subjects are measured in turn.
//
// The second half of this file computes medians and ratios of such measurements, with intervals.
#pragma once

#include <cmath>
#include <cstddef>
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

// Returns the processor time of this thread in one run of `work`, in ns. The work of other programs
// does not count, but their effect on caches and clock rates remains.
double ns_of(const std::function<void()>& work);
// Returns the wall-clock time of one run of `work`, in ns: for work in several threads.
double wall_ns_of(const std::function<void()>& work);

// The hash FNV-1a, over 64-bit words.
inline constexpr std::uint64_t first_hash = 0xcbf29ce484222325u;
constexpr std::uint64_t hashed(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ word) * 0x100000001b3u;
}

// Returns a hash of a result. The hash leaves out what depends on time, and what depends on
// searches before the step, such as the counts of marking.
std::uint64_t result_hash(const detector::StepResult& result);

// A function that returns the time of one run of `work`, in ns.
using Clock = double(const std::function<void()>& work);  // ns_of, wall_ns_of

// Makes the stages of a detector in this process; a test can replace some of them.
using MakeStages = std::function<detector::Stages(const detector::Options&)>;

struct SweptSubject {
  properties::WorkerProcess* worker = nullptr;    // null: the built-in detector in this process
  properties::Configuration configuration;        // with is_timed = true
  MakeStages stages = detector::standard_stages;  // of the built-in detector
};

struct SweepPlan {
  int rounds = 2;
  Clock* clock = ns_of;  // for subjects in this process
  // Subjects in this process look at each step once before it is timed, so that the time of a short
  // case does not include the cost of new memory.
  bool is_warm = false;
  // A subject is not run again if a step of its first run took more seconds than this. That run is
  // then the sample of every round.
  double longest_repeated = HUGE_VAL;
  // A subject whose time is more than this factor times the fastest subject's time takes part in
  // only two rounds.
  double far_off = HUGE_VAL;
  std::function<void()> tick = [] {};  // called between runs
};

// The runs of one case by one subject.
struct SweptRuns {
  std::optional<properties::CaseRun> first;   // the run that is judged
  std::vector<properties::RunTimes> samples;  // of each round, without the first run
  std::string ending;                         // in words, how the run ended if it did not complete
  bool is_once = false;  // the first run is the only run, and stands for every round
  bool has_differing_runs = false;

  // Return times in ms, one for each round.
  std::vector<double> sums() const;
  std::vector<double> of_step(std::size_t step) const;
  std::vector<double> create_ms() const;
};

// Lets each subject run the whole case `rounds` + 1 times. In each round all subjects run the case
// once: in the given order in the first round, then in the given and in the reverse order
// alternately, so that compared times are measured side by side. The first round is judged and not
// timed. The times of a worker are those of its own clock, with all of its threads. A subject whose
// run did not complete is not run again. Throws UnusableData if the detector in this process
// refuses the mesh, or answers a step with an error.
std::vector<SweptRuns> sweep(const corpus::Case& c, std::span<const SweptSubject> subjects,
                             const SweepPlan& plan);

// The rest of this file computes medians of repeated measurements, ratios of interleaved
// measurements, and quantiles. Intervals need no model of the noise: rank intervals come first,
// then bootstrap intervals. All results are deterministic.

// A median with a rank interval. The ends of the interval are order statistics of the samples: the
// closest pair x_(k), x_(n+1-k) between which the true median lies with probability 95 % or more.
// Whatever the distribution, that probability is 1 - 2 P(B < k) for B binomial (n, 1/2). Fewer than
// six samples cannot reach 95 %. The ends are then the least and the largest sample, and the median
// lies between them with probability 1 - 2^(1-n).
struct Estimate {
  double value = 0, lo = 0, hi = 0;
  std::vector<double> samples;  // raw, in the order in which they were taken
};

// Returns the median of the samples: for an even number of samples, the mean of the middle two.
// REQUIRES samples not empty.
Estimate median_of(std::vector<double> samples);

// Returns an estimate for a figure that is counted and not sampled.
Estimate exactly(double value);

// Returns the median of the ratios a[i] / b[i] of measurements that were taken next to each other,
// so that a slowdown of a whole round cancels. REQUIRES equal sizes.
Estimate ratio_of(std::span<const double> a, std::span<const double> b);

// Returns the estimate times `factor`, for example to turn ns a mesh into ns a triangle.
Estimate scaled(Estimate estimate, double factor);

// Returns the rank k, from 1, of the lower end of the rank interval of the median of n samples (see
// Estimate).
std::size_t rank_of_lower_end(std::size_t n);

// Returns the value at rank ceil(share * n) of the sorted samples (nearest rank). REQUIRES samples
// not empty.
double quantile(std::vector<double> samples, double share);

// Computes percentile bootstrap intervals of medians (Efron and Tibshirani, "An Introduction to the
// Bootstrap", 1993, section 13.3): the samples are drawn again with replacement many times, and the
// interval holds the middle 95 % of the medians of the draws.
//
// The intervals are deterministic: the draws come from the project's own integer random numbers,
// seeded alike for every call. A bootstrap interval is narrower than the rank interval if samples
// are few, and lacks the rank interval's guarantee: with five samples the true coverage is nearer
// to 85 than to 95 %.

// Returns the median with a bootstrap interval. REQUIRES samples not empty. Makes 2,000 draws, so
// the probability of the interval is right to about 1 %. O(2,000 n).
Estimate bootstrap_median(std::vector<double> samples);

// Returns the median of the ratios a[i] / b[i] of measurements taken next to each other, with a
// bootstrap interval. REQUIRES equal sizes.
Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b);

}  // namespace assay::reports
