#include "properties/worker/case_run.h"

#include <time.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>

#include "detector/assembly.h"
#include "properties/faults/fault.h"

namespace assay::properties {

using detector::Detector;

CasePlayer::CasePlayer(const Case& c, const Options& options, Detector detector)
    : case_(&c), script_(steps_of(c)), detector_(std::move(detector)) {
  for (std::size_t s = 0; s < script_.size(); ++s) {
    views_.push_back(given_view(view_of_step(c, s), options.culling));
  }
}

detector::Expected<CasePlayer> CasePlayer::make(const Case& c, const Options& options,
                                                std::optional<detector::Stages> stages,
                                                const StopFunction& stop) {
  Options of_case = options;
  of_case.counted = counted_of(c);
  auto creation = detector::assemble(c.triangles, c.frames.front(), of_case,
                                     stages ? *std::move(stages) : standard_stages(options), stop);
  if (!creation) return std::move(creation.error());
  return CasePlayer(c, options, std::move(creation.value()));
}

StepResult CasePlayer::play(std::size_t s, const StopFunction& stop) {
  if (!script_[s].commit) return look(s, stop);
  return detector_.step(x_t0(s), x_t1(s), views_[s], stop);
}

StepResult CasePlayer::look(std::size_t s, const StopFunction& stop) {
  return detector_.evaluate(x_t0(s), x_t1(s), views_[s], stop);
}

void note_error(CaseRun& run, std::size_t s, const std::string& text) {
  run.errors.resize(std::max(run.errors.size(), s + 1));
  auto& error = run.errors[s];
  error = (error.empty() ? "step " + std::to_string(s + 1) + ": " : error + "; ") + text;
  if (run.explanation.empty()) run.explanation = error;
}

std::string error_of(const CaseRun& run, std::size_t s) {
  return s < run.errors.size() ? run.errors[s] : "";
}

void note_capacity(CaseRun& run, std::size_t s) {
  run.over_capacity.resize(std::max(run.over_capacity.size(), s + 1));
  run.over_capacity[s] = 1;
}

bool is_over_capacity(const CaseRun& run, std::size_t s) {
  return s < run.over_capacity.size() && run.over_capacity[s] != 0;
}

CaseRun out_of_memory() { return {RunEnd::out_of_memory, "out of memory", {}}; }

namespace {

detector::Stages stages_of(const Configuration& configuration) {
  const Fault* fault = configuration.fault.empty() ? nullptr : find_fault(configuration.fault);
  return fault ? fault->stages(configuration.options)
               : detector::standard_stages(configuration.options);
}

StepResult run_step(CasePlayer& player, std::size_t s) try {
  return player.play(s);
} catch (const std::bad_alloc&) {
  StepResult undecided;
  undecided.answer = Answer::undecided;
  return undecided;
}

// Returns how far the caller may go in the step; nothing without an answer. The state stays as it
// is.
std::optional<LimitAnswer> limit_of(CasePlayer& player, std::size_t s) try {
  auto limit = player.detector().limit(player.x_t0(s), player.x_t1(s));
  if (limit.answer != Answer::free && limit.answer != Answer::collision) return std::nullopt;
  return LimitAnswer{limit.share, std::move(limit.positions)};
} catch (const std::bad_alloc&) {
  return std::nullopt;
}

// The counters are plain numbers without gaps between them, so they can be compared byte by byte.
static_assert(std::has_unique_object_representations_v<detector::StepCounts>);

bool same_primitive(const ViewPrimitive& a, const ViewPrimitive& b) {
  return a.q0.t0 == b.q0.t0 && a.q0.t1 == b.q0.t1 && a.q1.t0 == b.q1.t0 && a.q1.t1 == b.q1.t1;
}

bool same_path(const MovingPoint& a, const MovingPoint& b) { return a.t0 == b.t0 && a.t1 == b.t1; }

bool same_contact(const PairContact& a, const PairContact& b) {
  return a.pair == b.pair && a.time == b.time && a.feature.kind == b.feature.kind &&
         a.feature.vertices == b.feature.vertices;
}

bool same_limit(const std::optional<LimitAnswer>& a, const std::optional<LimitAnswer>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->share == b->share && a->positions == b->positions;
}

bool same_result(const StepResult& a, const StepResult& b) {
  const auto equal = [](const auto& x, const auto& y, auto same) {
    return std::ranges::equal(x, y, same);
  };
  return a.answer == b.answer && a.first == b.first && a.signs == b.signs &&
         a.view_positive == b.view_positive && a.view_negative == b.view_negative &&
         a.view_zero == b.view_zero && a.doubts == b.doubts &&
         equal(a.apexes, b.apexes, same_path) && equal(a.pairs, b.pairs, same_contact) &&
         equal(a.primitives, b.primitives, same_primitive) &&
         std::memcmp(&a.counts, &b.counts, sizeof a.counts) == 0;
}

}  // namespace

CaseRun run_case(const Case& c, const Configuration& configuration) try {
  CaseRun run;
  RunClock clock(configuration.is_timed);
  auto player = CasePlayer::make(c, configuration.options, stages_of(configuration));
  if (!player) return {RunEnd::refused, player.error().message, {}};
  clock.created();
  for (std::size_t s = 0; s < player.value().steps(); ++s) {
    if (configuration.asks_limits) run.limits.push_back(limit_of(player.value(), s));
    clock.begin();
    run.steps.push_back(run_step(player.value(), s));
    clock.end_step();
    const auto& result = run.steps.back();
    if (result.problem) note_error(run, s, result.problem->message);
    // Only lack of memory ends a step here without an answer.
    if (result.answer == Answer::undecided) note_error(run, s, "out of memory");
  }
  run.times = clock.take();
  return run;
} catch (const std::bad_alloc&) {
  return out_of_memory();
}

std::vector<StepResult> run_disturbed(const Case& c, const Configuration& configuration,
                                      std::span<const StepResult> undisturbed) {
  constexpr int most_stops = 8;
  auto player = CasePlayer::make(c, configuration.options, stages_of(configuration));
  auto beside = CasePlayer::make(c, configuration.options, stages_of(configuration));
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < player.value().steps(); ++s) {
    std::vector<StepResult> after_stops;
    for (int stop_at = 1; stop_at <= most_stops; ++stop_at) {
      int questions = 0;
      const auto stop = [&] { return ++questions == stop_at; };
      const auto answer = player.value().look(s, stop);
      if (answer.answer != Answer::undecided) break;
      after_stops.push_back(player.value().look(s));
    }
    const auto meanwhile = [&] {
      beside.value().look(s);
      return false;
    };
    results.push_back(player.value().play(s, meanwhile));
    const auto differs = [&](const StepResult& disturbed) {
      return !same_answers(without_marking_counts({disturbed}),
                           without_marking_counts({undisturbed[s]}));
    };
    const auto other = std::ranges::find_if(after_stops, differs);
    if (other != after_stops.end() && !differs(results.back())) results.back() = *other;
  }
  return results;
}

CaseRun without_marking_counts(std::vector<StepResult> results) {
  CaseRun run;
  run.steps = std::move(results);
  for (auto& step : run.steps) step.counts.marking = {};
  return run;
}

bool same_answers(const CaseRun& a, const CaseRun& b) {
  return a.end == b.end && a.explanation == b.explanation && a.has_answers == b.has_answers &&
         a.errors == b.errors && a.over_capacity == b.over_capacity &&
         a.candidates == b.candidates && std::ranges::equal(a.limits, b.limits, same_limit) &&
         std::ranges::equal(a.steps, b.steps, same_result);
}

namespace {

double processor_seconds_here() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Returns the peak memory. It does not use getrusage(), because that value outlives exec(), and so
// includes the memory of the process that started this one.
std::uint64_t peak_bytes_here() {
  constexpr std::uint64_t bytes_a_kilobyte = 1024;
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    std::uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return bytes_a_kilobyte * kilobytes;
  }
  return 0;
}

}  // namespace

double RunClock::lap() {
  if (!is_on_) return 0;
  const double before = last_;
  last_ = processor_seconds_here();
  return last_ - before;
}

std::optional<RunTimes> RunClock::take() {
  if (!is_on_) return std::nullopt;
  times_.peak_bytes = peak_bytes_here();
  return std::move(times_);
}

}  // namespace assay::properties
