// Suite `sequences` times whole sequences with each culling, and with several threads.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>

#include "reports/bench/cases.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

struct TimedScene {
  const char* name;
  int triangles = 10'000;
};
// The contacts of the two smaller ones grow with the square of the triangles. With as many
// triangles as the others have, each of their steps takes seconds.
constexpr TimedScene scenes_timed[] = {{"breathing-sphere"},
                                       {"two-spheres"},
                                       {"dented-sphere"},
                                       {"bend"},
                                       {"twist"},
                                       {"open-tube"},
                                       {"pinching-torus"},
                                       {"folding-sheet"},
                                       {"crumpling-sphere"},
                                       {"arm-in-box"},
                                       {"ball-in-tube"},
                                       {"inverted-sleeve", 1'000},
                                       {"crossing-fans"},
                                       {"winding-spiral", 2'000}};

// The single cullings, auto, then those of all cores.
std::vector<Options> subjects_of(Start start, std::uint32_t cores) {
  std::vector<Options> subjects;
  for (const auto culling : {Culling::bvh, Culling::normal_cone, Culling::view_point,
                             Culling::view_line, Culling::automatic})
    subjects.push_back(options_of_sequence(culling, start, 1));
  for (const auto culling : {Culling::bvh, Culling::automatic})
    subjects.push_back(options_of_sequence(culling, start, cores));
  return subjects;
}

struct Played {
  std::string name;
  std::vector<Options> subjects;
  std::vector<SweptRuns> runs;  // by subject

  static constexpr std::size_t singles = 4, automatic = 4, bvh_of_all = 5, automatic_of_all = 6;
  std::size_t best_single() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < singles; ++i) {
      if (median_of(runs[i].sums()).value < median_of(runs[best].sums()).value) best = i;
    }
    return best;
  }
  std::size_t steps() const { return runs[0].first->steps.size(); }
};

// All runs must agree in answers, pairs and times of contact, and runs with one culling in
// everything that result_hash() covers, whatever their threads.
void find_differences(const Played& played, BenchReport& report) {
  std::map<std::pair<std::size_t, Culling>, std::uint64_t> hashes;
  for (std::size_t i = 0; i < played.runs.size(); ++i) {
    for (std::size_t s = 0; s < played.steps(); ++s) {
      const auto& result = played.runs[i].first->steps[s];
      const auto label = fmt::format("{}, step {}", played.name, s + 1);
      const auto hash = result_hash(result);
      if (hashes.try_emplace({s, played.subjects[i].culling}, hash).first->second != hash)
        report.wrong_answers.push_back(label + ": the same culling gives another result");
      const auto& first = played.runs[0].first->steps[s];
      const bool same =
          result.answer == first.answer && result.first == first.first &&
          std::equal(result.pairs.begin(), result.pairs.end(), first.pairs.begin(),
                     first.pairs.end(), [](const PairContact& one, const PairContact& other) {
                       return one.pair == other.pair && one.time == other.time;
                     });
      if (!same) report.wrong_answers.push_back(label + ": two cullings find different pairs");
    }
    if (played.runs[i].has_differing_runs)
      report.wrong_answers.push_back(played.name + ": two runs differ");
  }
}

// The ratio over the rounds that both took part in.
Estimate ratio_in_common(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t rounds = std::min(a.size(), b.size());
  return ratio_of(std::span(a).first(rounds), std::span(b).first(rounds));
}

// Adds the times of all cullings over that of bvh, for users who want to choose by themselves.
void add_table_rows(const Played& played, BenchReport& report) {
  for (std::size_t i = 0; i < played.runs.size(); ++i) {
    const auto& subject = played.subjects[i];
    const auto sums = played.runs[i].sums();
    report.add(
        fmt::format("{}, {}, {} thread{}: sum over bvh's", played.name, name_of(subject.culling),
                    subject.threads, subject.threads == 1 ? "" : "s"),
        "times", ratio_in_common(sums, played.runs[0].sums()), {},
        fmt::format("{:.2f} ms a step",
                    median_of(sums).value / static_cast<double>(played.steps())));
  }
}

void judge_automatic(const Played& played, BenchReport& report) {
  const auto& automatic = played.runs[Played::automatic];
  const auto& best = played.runs[played.best_single()];
  const std::string name = played.name + ", auto over the best single culling";
  const std::string note = name_of(played.subjects[played.best_single()].culling);
  report.add(name + ", sum", "times", ratio_in_common(automatic.sums(), best.sums()),
             wanted::auto_over_best_culling, note);
  std::vector<double> ratios;
  double worst = 0;
  std::size_t worst_step = 0;
  for (std::size_t s = 0; s < played.steps(); ++s) {
    const double ratio = ratio_in_common(automatic.of_step(s), best.of_step(s)).value;
    ratios.push_back(ratio);
    constexpr double long_enough_ms = 1;
    if (ratio > worst && median_of(automatic.of_step(s)).value >= long_enough_ms) {
      worst = ratio;
      worst_step = s;
    }
  }
  report.add(name + ", median step", "times", median_of(ratios), wanted::auto_over_best_culling,
             note);
  if (worst > 0) {
    report.add(name + ", worst step of 1 ms", "times", exactly(worst),
               wanted::auto_step_over_best_culling, fmt::format("step {}", worst_step + 1));
  }
  report.add(played.name + ", auto over bvh, first step", "times",
             ratio_in_common(automatic.of_step(0), played.runs[0].of_step(0)),
             wanted::first_step_over_bvh);
}

void judge_threads(const Played& played, std::uint32_t cores, BenchReport& report) {
  const bool is_asked = cores == 2 && (played.name == "rod-twist" || played.name == "kick");
  for (const auto& [alone, all] : {std::pair(std::size_t{0}, Played::bvh_of_all),
                                   std::pair(Played::automatic, Played::automatic_of_all)}) {
    report.add(fmt::format("{}, {}: one thread over {}", played.name,
                           name_of(played.subjects[alone].culling), cores),
               "times", ratio_in_common(played.runs[alone].sums(), played.runs[all].sums()),
               wanted_if(is_asked, wanted::two_threads_gain));
  }
}

}  // namespace

BenchReport sequences_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("sequences");
  const std::uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
  constexpr int frames = 9, full_rounds = 15;
  const auto play = [&](const std::string& name, const corpus::Sequence& sequence, Start start) {
    progress.phase(name);
    Played played{name, subjects_of(start, cores), {}};
    const auto timed = timed_case(name, sequence, start);
    std::vector<SweptSubject> swept;
    for (const auto& options : played.subjects) swept.push_back({nullptr, {name, options}});
    // A culling that takes three times as long as another one is no choice, and two rounds suffice
    // to tell how far off it is.
    played.runs = sweep(timed.c, swept,
                        {.rounds = settings.rounds(full_rounds),
                         .clock = wall_ns_of,
                         .far_off = 3,
                         .tick = progress.tick});
    find_differences(played, report);
    add_table_rows(played, report);
    judge_automatic(played, report);
    if (cores > 1) judge_threads(played, cores, report);
  };
  for (const auto& [scene, triangles] : scenes_timed)
    play(scene, bench_scene(scene, settings.triangles(triangles), frames), Start::clean);
  std::vector<std::string> missing;
  for (const auto& real : real_sequences(settings, missing))
    play(real.name, real.frames, real.start());
  for (const auto& file : missing) report.add_no_data("a public sequence", file);
  return report;
}

}  // namespace assay::reports
