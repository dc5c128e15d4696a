#include "reports/bench/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>

#include "detector/assembly.h"
#include "detector/detector.h"
#include "properties/worker/case_player.h"
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

using namespace detector;

void sweep_steps(const corpus::Case& c, std::span<const Options> subjects, int rounds,
                 const OnStep& on_step, const std::function<void()>& tick) {
  std::vector<properties::CasePlayer> players;
  for (const auto& options : subjects) {
    auto player = properties::CasePlayer::make(c, options);
    if (!player) throw UnusableData(c.id + ": " + player.error().message);
    players.push_back(std::move(player.value()));
  }
  for (std::size_t s = 0; s < players.front().steps(); ++s) {
    std::vector<SweptStep> swept(players.size());
    std::vector<Measurement> measurements;
    for (std::size_t i = 0; i < players.size(); ++i) {
      measurements.push_back([&, i] {
        tick();
        auto& [all_ns, broad_phase_ns, result, hash, differs] = swept[i];
        const double ns = ns_of([&, &looked = result] { looked = players[i].look(s); });
        if (result.answer == Answer::error)
          throw UnusableData(c.id + ": " + result.problem->message);
        const auto hash_now = result_hash(result);
        differs |= hash != 0 && hash != hash_now;
        hash = hash_now;
        broad_phase_ns.push_back(1e6 * result.times.broad_phase);
        return ns;
      });
    }
    auto samples = interleave(rounds, measurements);
    for (std::size_t i = 0; i < players.size(); ++i) {
      swept[i].ns = std::move(samples[i]);
      swept[i].broad_phase_ns.erase(swept[i].broad_phase_ns.begin());  // of the first round
    }
    on_step(s, swept);
    if (!players.front().step(s).commit) continue;
    for (auto& player : players) player.detector().commit();
  }
}

std::vector<double> SweptRun::sums() const {
  std::vector<double> sums;
  for (const auto& round : ns) sums.push_back(std::accumulate(round.begin(), round.end(), 0.0));
  return sums;
}

std::vector<double> SweptRun::of_step(std::size_t step) const {
  std::vector<double> values;
  for (const auto& round : ns) values.push_back(round[step]);
  return values;
}

Estimate ratio_in_common(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t rounds = std::min(a.size(), b.size());
  return ratio_of(std::span(a).first(rounds), std::span(b).first(rounds));
}

std::vector<SweptRun> sweep_runs(const std::string& name, const corpus::Sequence& sequence,
                                 std::span<const Options> subjects, int rounds, Clock& clock,
                                 BenchReport& report) {
  std::vector<SweptRun> runs(subjects.size());
  std::map<std::pair<std::size_t, Culling>, std::uint64_t> hashes;
  const auto play = [&](std::size_t i) {
    const bool is_first = runs[i].results.empty();
    auto detector =
        made(Detector::create(sequence.triangles, sequence.frames[0], subjects[i]), name);
    std::vector<double> ns;
    for (std::size_t s = 0; s + 1 < sequence.frames.size(); ++s) {
      StepResult result;
      ns.push_back(
          clock([&] { result = detector.step(sequence.frames[s], sequence.frames[s + 1]); }));
      const std::string label = fmt::format("{}, step {}", name, s + 1);
      const auto hash = result_hash(result);
      if (hashes.try_emplace({s, subjects[i].culling}, hash).first->second != hash)
        report.wrong_answers.push_back(label + ": the same culling gives another result");
      if (is_first) runs[i].results.push_back(result);
      check_same_pairs(label, runs[0].results[s], result, report);
    }
    return ns;
  };
  // A subject that takes this many times as long as another one is no choice, and a few rounds
  // suffice to tell how far off it is.
  constexpr double far_off = 3;
  constexpr int rounds_of_far_off = 2;
  std::vector<double> first;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const auto ns = play(i);
    first.push_back(std::accumulate(ns.begin(), ns.end(), 0.0));
  }
  const double least = *std::min_element(first.begin(), first.end());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t n = 0; n < subjects.size(); ++n) {
      const std::size_t i = round % 2 == 0 ? n : subjects.size() - 1 - n;
      const bool is_far_off = first[i] > far_off * least;
      if (!is_far_off || round < rounds_of_far_off) runs[i].ns.push_back(play(i));
    }
  }
  return runs;
}

namespace {

// Makes one more run. Returns milliseconds a step, 0 if there are none.
double run_once(const corpus::Case& c, const WorkerSubject& subject, double longest_repeated,
                WorkerRuns& runs) {
  constexpr double ms_a_second = 1e3;
  if (!runs.ended.empty()) return 0;
  if (runs.is_once) {
    runs.create_ms.push_back(runs.create_ms.front());
    runs.ms_a_step.push_back(runs.ms_a_step.front());
    return runs.ms_a_step.front();
  }
  auto run = std::move(subject.worker->run(c, {&subject.configuration, 1}).front());
  if (run.end != properties::RunEnd::completed || !run.times) {
    runs.ended = fmt::format("{}: {}", name_of(run.end), run.explanation);
    if (!runs.first) runs.first = std::move(run);
    return 0;
  }
  const auto& steps = run.times->steps;
  const double ms = ms_a_second * std::accumulate(steps.begin(), steps.end(), 0.) /
                    static_cast<double>(steps.size());
  if (!runs.first) {
    runs.is_once = std::any_of(steps.begin(), steps.end(),
                               [&](double seconds) { return seconds > longest_repeated; });
  } else {
    runs.has_differing_runs |= !same_answers(run, *runs.first);
  }
  if (runs.first || runs.is_once) {
    runs.create_ms.push_back(ms_a_second * run.times->create);
    runs.ms_a_step.push_back(ms);
  }
  if (!runs.first) runs.first = std::move(run);
  return ms;
}

}  // namespace

std::vector<WorkerRuns> sweep_workers(const corpus::Case& c,
                                      std::span<const WorkerSubject> subjects, int rounds,
                                      const std::function<void()>& tick, double longest_repeated) {
  std::vector<WorkerRuns> runs(subjects.size());
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    measurements.push_back([&, i] {
      tick();
      return run_once(c, subjects[i], longest_repeated, runs[i]);
    });
  }
  interleave(rounds, measurements);
  for (auto& run : runs) {
    // Its first run was one of rounds + 1 samples; each round has one.
    if (run.is_once && run.ended.empty()) run.ms_a_step.resize(static_cast<std::size_t>(rounds));
  }
  return runs;
}

}  // namespace assay::reports
