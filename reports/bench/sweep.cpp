#include "reports/bench/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "detector/detector.h"
#include "properties/worker/case_player.h"
#include "reports/bench/suites.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {

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
        const double ns = ns_of([&] { result = players[i].look(s); });
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
