#include "reports/bench/sweep.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <numeric>

#include "detector/detector.h"
#include "properties/worker/case_run.h"
#include "reports/bench/suites.h"

namespace assay::reports {

double ns_of(const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

double wall_ns_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
  return taken.count();
}

std::vector<std::vector<double>> interleave(int rounds,
                                            const std::vector<Measurement>& measurements) {
  const std::size_t count = measurements.size();
  for (const auto& measure : measurements) measure();
  std::vector<std::vector<double>> samples(count);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = round % 2 == 0 ? k : count - 1 - k;
      samples[i].push_back(measurements[i]());
    }
  }
  return samples;
}

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

namespace {

constexpr double ms_a_second = 1e3;

double sum_ms(const properties::RunTimes& times) {
  return ms_a_second * std::accumulate(times.steps.begin(), times.steps.end(), 0.);
}

properties::CaseRun run_here(const corpus::Case& c, const Options& options, const SweepPlan& plan) {
  constexpr double seconds_a_ns = 1e-9;
  properties::CaseRun run;
  properties::RunTimes times;
  std::optional<Expected<properties::CasePlayer>> player;
  times.create =
      seconds_a_ns * plan.clock([&] { player.emplace(properties::CasePlayer::make(c, options)); });
  if (!*player) throw UnusableData(c.id + ": " + player->error().message);
  auto& steps = player->value();
  for (std::size_t s = 0; s < steps.steps(); ++s) {
    StepResult result;
    if (plan.is_warm) steps.look(s);
    times.steps.push_back(
        seconds_a_ns * plan.clock([&] { result = plan.is_warm ? steps.look(s) : steps.play(s); }));
    if (result.answer == Answer::error) throw UnusableData(c.id + ": " + result.problem->message);
    if (plan.is_warm && steps.step(s).commit) steps.detector().commit();
    run.steps.push_back(std::move(result));
  }
  run.times = std::move(times);
  return run;
}

}  // namespace

std::vector<double> SweptRuns::sums() const {
  std::vector<double> ms;
  for (const auto& times : samples) ms.push_back(sum_ms(times));
  return ms;
}

std::vector<double> SweptRuns::of_step(std::size_t step) const {
  std::vector<double> ms;
  for (const auto& times : samples) ms.push_back(ms_a_second * times.steps[step]);
  return ms;
}

std::vector<double> SweptRuns::create_ms() const {
  std::vector<double> ms;
  for (const auto& times : samples) ms.push_back(ms_a_second * times.create);
  return ms;
}

std::vector<SweptRuns> sweep(const corpus::Case& c, std::span<const SweptSubject> subjects,
                             const SweepPlan& plan) {
  constexpr std::size_t rounds_of_far_off = 2;
  std::vector<SweptRuns> runs(subjects.size());
  std::vector<double> first_ms(subjects.size(), HUGE_VAL);
  const auto run_once = [&](std::size_t i) {
    plan.tick();
    const auto& [worker, configuration] = subjects[i];
    auto& of = runs[i];
    if (!of.ended.empty()) return 0.;
    if (of.is_once) {
      of.samples.push_back(*of.first->times);
      return 0.;
    }
    const double least = *std::min_element(first_ms.begin(), first_ms.end());
    if (of.first && of.samples.size() >= rounds_of_far_off && first_ms[i] > plan.far_off * least)
      return 0.;
    auto run = worker ? std::move(worker->run(c, {&configuration, 1}).front())
                      : run_here(c, configuration.options, plan);
    if (run.end != properties::RunEnd::completed || !run.times) {
      of.ended = fmt::format("{}: {}", name_of(run.end), run.explanation);
      if (!of.first) of.first = std::move(run);
      return 0.;
    }
    if (of.first) {
      of.has_differing_runs |= !same_answers(run, *of.first);
      of.samples.push_back(std::move(*run.times));
      return 0.;
    }
    first_ms[i] = sum_ms(*run.times);
    of.is_once = std::any_of(run.times->steps.begin(), run.times->steps.end(),
                             [&](double seconds) { return seconds > plan.longest_repeated; });
    of.first = std::move(run);
    return 0.;
  };
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < subjects.size(); ++i)
    measurements.push_back([&, i] { return run_once(i); });
  interleave(plan.rounds, measurements);
  return runs;
}

}  // namespace assay::reports
