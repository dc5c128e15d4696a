#include "reports/bench/sweep.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "properties/judging/exam.h"
#include "properties/random.h"
#include "reports/bench/cases.h"

namespace assay::reports {

namespace {

double ns_by(clockid_t clock, const std::function<void()>& work) {
  const auto now = [&] {
    timespec time{};
    clock_gettime(clock, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

}  // namespace

double ns_of(const std::function<void()>& work) { return ns_by(CLOCK_THREAD_CPUTIME_ID, work); }
double wall_ns_of(const std::function<void()>& work) { return ns_by(CLOCK_MONOTONIC, work); }

using namespace detector;

std::uint64_t result_hash(const StepResult& result) {
  std::uint64_t hash = first_hash;
  const auto add = [&](const auto&... items) {
    const auto add_one = [&](const auto& item) {
      if constexpr (std::is_same_v<decltype(item), const double&>)
        hash = hashed(hash, std::bit_cast<std::uint64_t>(item));
      else
        hash = hashed(hash, static_cast<std::uint64_t>(item));
    };
    (add_one(items), ...);
  };
  add(result.answer, result.first.lo, result.first.hi);
  for (const auto& [pair, time, feature] : result.pairs) {
    add(pair.a, pair.b, time.lo, time.hi, feature.kind);
    for (const auto v : feature.vertices) add(v);
  }
  const auto& counts = result.counts;
  add(result.view_positive, result.view_negative, result.view_zero, result.against_all,
      counts.search.box_tests, counts.search.child_counts, counts.search.skipped,
      counts.search.contour_tests, counts.search.candidate_pairs, counts.narrow.elementary_tests,
      counts.narrow.rungs.by_integers(), counts.view.lanes, counts.view.filter, counts.view.exact,
      counts.closure_rounds);
  for (const auto sign : result.signs) add(sign);
  return hash;
}

namespace {

constexpr double ms_a_second = 1e3;

double sum_ms(const properties::RunTimes& times) {
  return ms_a_second * std::accumulate(times.steps.begin(), times.steps.end(), 0.);
}

properties::CaseRun run_here(const corpus::Case& c, const SweptSubject& subject,
                             const SweepPlan& plan) {
  constexpr double seconds_a_ns = 1e-9;
  properties::CaseRun run;
  properties::RunTimes times;
  const auto& options = subject.configuration.options;
  std::optional<properties::CasePlayer> player;
  times.create = seconds_a_ns * plan.clock([&] {
    player = take(properties::CasePlayer::make(c, options, subject.stages(options)), c.id);
  });
  auto& steps = *player;
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

// Returns for each round the time that `ms` computes from the times of the round.
template <class Ms>
std::vector<double> each(const SweptRuns& runs, const Ms& ms) {
  std::vector<double> list;
  for (const auto& times : runs.samples) list.push_back(ms(times));
  return list;
}

}  // namespace

std::vector<double> SweptRuns::sums() const { return each(*this, sum_ms); }

std::vector<double> SweptRuns::of_step(std::size_t step) const {
  return each(*this, [&](const auto& times) { return ms_a_second * times.steps[step]; });
}

std::vector<double> SweptRuns::create_ms() const {
  return each(*this, [](const auto& times) { return ms_a_second * times.create; });
}

std::vector<SweptRuns> sweep(const corpus::Case& c, std::span<const SweptSubject> subjects,
                             const SweepPlan& plan) {
  constexpr std::size_t rounds_of_far_off = 2;
  std::vector<SweptRuns> runs(subjects.size());
  std::vector<double> first_ms(subjects.size(), HUGE_VAL);
  const auto run_once = [&](std::size_t i) {
    plan.tick();
    const auto& subject = subjects[i];
    auto& of = runs[i];
    if (!of.ending.empty()) return;
    if (of.is_once) return of.samples.push_back(*of.first->times);
    const double least = *std::min_element(first_ms.begin(), first_ms.end());
    if (of.samples.size() >= rounds_of_far_off && first_ms[i] > plan.far_off * least) return;
    auto run = subject.worker ? run_alone(*subject.worker, c, subject.configuration)
                              : run_here(c, subject, plan);
    if (run.end != properties::RunEnd::completed || !run.times) {
      of.ending = fmt::format("{}: {}", name_of(run.end), run.explanation);
    } else if (of.first) {
      of.has_differing_runs |= !same_answers(run, *of.first);
      of.samples.push_back(std::move(*run.times));
    } else {
      first_ms[i] = sum_ms(*run.times);
      of.is_once = std::any_of(run.times->steps.begin(), run.times->steps.end(),
                               [&](double seconds) { return seconds > plan.longest_repeated; });
    }
    if (!of.first) of.first = std::move(run);
  };
  for (int round = -1; round < plan.rounds; ++round) {
    for (std::size_t k = 0; k < subjects.size(); ++k)
      run_once(round % 2 == 1 ? subjects.size() - 1 - k : k);
  }
  return runs;
}

std::size_t rank_of_lower_end(std::size_t n) {
  constexpr double risk = 0.05;
  // term is P(B = k), and below is P(B < k).
  double term = std::pow(0.5, static_cast<double>(n)), below = 0;
  std::size_t k = 0;
  while (k < n / 2 && 2 * (below + term) <= risk) {
    below += term;
    term *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    ++k;
  }
  return std::max<std::size_t>(k, 1);
}

Estimate median_of(std::vector<double> samples) {
  std::vector<double> ascending = samples;
  std::sort(ascending.begin(), ascending.end());
  const std::size_t n = ascending.size(), k = rank_of_lower_end(n);
  return {(ascending[(n - 1) / 2] + ascending[n / 2]) / 2, ascending[k - 1], ascending[n - k],
          std::move(samples)};
}

Estimate exactly(double value) { return {value, value, value, {value}}; }

namespace {

std::vector<double> ratios(std::span<const double> a, std::span<const double> b) {
  std::vector<double> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] / b[i]);
  return out;
}

// Computes the median, and reorders its argument for that.
double median_in_place(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

// Draws items with replacement 2,000 times, from generators that are seeded alike. `figure_of` gets
// the indices that were drawn. The result is the interval that holds the middle 95 % of its values.
template <class FigureOf>
Estimate over_draws(std::size_t items, const FigureOf& figure_of) {
  constexpr int draws = 2'000;
  constexpr double share_below = 0.025;  // of the draws lies below the interval, and as much above
  properties::Random random("percentile bootstrap");
  std::vector<std::size_t> places(items);
  std::vector<double> figures;
  for (int d = 0; d < draws; ++d) {
    for (auto& i : places) i = static_cast<std::size_t>(random.below(static_cast<int>(items)));
    figures.push_back(figure_of(places));
  }
  return {0, quantile(figures, share_below), quantile(figures, 1 - share_below), {}};
}

}  // namespace

Estimate ratio_of(std::span<const double> a, std::span<const double> b) {
  return median_of(ratios(a, b));
}

Estimate scaled(Estimate estimate, double factor) {
  for (double* x : {&estimate.value, &estimate.lo, &estimate.hi}) *x *= factor;
  for (double& x : estimate.samples) x *= factor;
  return estimate;
}

double quantile(std::vector<double> samples, double share) {
  const auto n = static_cast<double>(samples.size());
  const auto rank = static_cast<std::size_t>(std::clamp(std::ceil(share * n), 1.0, n));
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

Estimate bootstrap_median(std::vector<double> samples) {
  std::vector<double> values = samples;
  auto out = over_draws(samples.size(), [&](const std::vector<std::size_t>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) values[i] = samples[places[i]];
    return median_in_place(values);
  });
  values = samples;
  out.value = median_in_place(values);
  out.samples = std::move(samples);
  return out;
}

Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b) {
  return bootstrap_median(ratios(a, b));
}

}  // namespace assay::reports
