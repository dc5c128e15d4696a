#include "reports/bench/timed_step.h"

#include <algorithm>
#include <bit>

#include "detector/assembly.h"
#include "reports/bench/interleave.h"
#include "reports/bench/suites.h"

namespace assay::reports {
namespace {

using namespace detector;

// The hash FNV-1a, over 64-bit words.
class Hash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

std::uint64_t result_hash(const StepResult& result) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(result.answer));
  hash.add(result.first.lo);
  hash.add(result.first.hi);
  for (const auto& contact : result.pairs) {
    hash.add(static_cast<std::uint64_t>(contact.pair.a));
    hash.add(static_cast<std::uint64_t>(contact.pair.b));
    hash.add(contact.time.lo);
    hash.add(contact.time.hi);
    hash.add(static_cast<std::uint64_t>(contact.feature.kind));
    for (const auto v : contact.feature.vertices) hash.add(static_cast<std::uint64_t>(v));
  }
  for (const std::uint64_t count :
       {std::uint64_t{result.view_positive}, std::uint64_t{result.view_negative},
        std::uint64_t{result.view_zero}, std::uint64_t{result.against_all},
        result.counts.search.box_tests, result.counts.search.child_counts,
        result.counts.search.skipped, result.counts.search.contour_tests,
        result.counts.search.candidate_pairs, result.counts.narrow.elementary_tests,
        result.counts.narrow.rungs.by_integers(), result.counts.view.lanes,
        result.counts.view.filter, result.counts.view.exact, result.counts.closure_rounds}) {
    hash.add(count);
  }
  for (const auto sign : result.signs) hash.add(static_cast<std::uint64_t>(sign));
  return hash.value();
}

TimedStep::TimedStep(std::string name, const Triangles& triangles,
                     std::span<const Positions> frames, const Options& options, BenchReport& report)
    : TimedStep(std::move(name), triangles, frames, options, standard_stages(options), report) {}

TimedStep::TimedStep(std::string name, const Triangles& triangles,
                     std::span<const Positions> frames, const Options& options, Stages stages,
                     BenchReport& report)
    : name_(std::move(name)),
      frames_(frames.last(2)),
      detector_(made(detector::assemble(triangles, frames[0], options, std::move(stages)), name_)),
      report_(report) {
  for (std::size_t f = 0; f + 2 < frames.size(); ++f) detector_.step(frames[f], frames[f + 1]);
}

double TimedStep::time() {
  const double ns = ns_of([&] { result_ = detector_.evaluate(frames_[0], frames_[1]); });
  if (result_.answer == Answer::error) throw UnusableData(name_ + ": " + result_.problem->message);
  const std::uint64_t hash = result_hash(result_);
  if (evaluated_ && hash != hash_) {
    report_.wrong_answers.push_back(name_ + ": two evaluations of one step differ");
  }
  hash_ = hash;
  evaluated_ = true;
  return ns;
}

const StepResult& TimedStep::result() {
  if (!evaluated_) time();
  return result_;
}

double TimedStep::positive_share() {
  const auto triangles = static_cast<double>(detector_.topology().triangles.size());
  return static_cast<double>(result().view_positive) / triangles;
}

Options bench_options(Culling culling, Arithmetic arithmetic) {
  return {culling, Start::clean, Pairs::all, arithmetic};
}

Options options_of_sequence(Culling culling, Start start, std::uint32_t threads) {
  Options options = bench_options(culling);
  options.start = start;
  options.threads = threads;
  return options;
}

Detector made(Expected<Detector> detector, const std::string& name) {
  if (!detector) throw UnusableData(name + ": " + detector.error().message);
  return std::move(detector.value());
}

void check_same_pairs(const std::string& name, const StepResult& a, const StepResult& b,
                      BenchReport& report) {
  const bool same = a.answer == b.answer && a.first == b.first &&
                    std::equal(a.pairs.begin(), a.pairs.end(), b.pairs.begin(), b.pairs.end(),
                               [](const PairContact& one, const PairContact& other) {
                                 return one.pair == other.pair && one.time == other.time;
                               });
  if (!same) report.wrong_answers.push_back(name + ": two cullings find different pairs");
}

}  // namespace assay::reports
