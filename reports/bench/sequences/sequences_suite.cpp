// Suite `sequences` times whole sequences with each culling, and with several threads.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <thread>

#include "properties/judging/case_options.h"
#include "reports/bench/real_sequences.h"
#include "reports/bench/sequences/sequence_times.h"
#include "reports/bench/suites.h"
#include "reports/bench/timed_step.h"

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

struct Played {
  std::string name;
  std::vector<SequenceVariant> variants;  // the single cullings, auto, then those of all cores

  static constexpr std::size_t singles = 4, automatic = 4, bvh_of_all = 5, automatic_of_all = 6;
  const SequenceVariant& bvh() const { return variants[0]; }
  const SequenceVariant& best_single() const {
    return *std::min_element(variants.begin(), variants.begin() + singles,
                             [](const SequenceVariant& a, const SequenceVariant& b) {
                               return median_of(a.sums()).value < median_of(b.sums()).value;
                             });
  }
  std::size_t steps() const { return variants[0].ms[0].size(); }
};

std::vector<SequenceVariant> variants_of(std::uint32_t cores) {
  return {{Culling::bvh, 1},          {Culling::normal_cone, 1}, {Culling::view_point, 1},
          {Culling::view_line, 1},    {Culling::automatic, 1},   {Culling::bvh, cores},
          {Culling::automatic, cores}};
}

// The ratio over the rounds in which both were played.
Estimate ratio_in_common(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t rounds = std::min(a.size(), b.size());
  return ratio_of(std::span(a).first(rounds), std::span(b).first(rounds));
}

// Adds the times of all cullings over that of bvh, for users who want to choose by themselves.
void add_table_rows(const Played& played, BenchReport& report) {
  for (std::size_t i = 0; i < played.variants.size(); ++i) {
    const auto& variant = played.variants[i];
    report.add(fmt::format("{}, {}, {} thread{}: sum over bvh's", played.name,
                           properties::name_of(variant.culling), variant.threads,
                           variant.threads == 1 ? "" : "s"),
               "times", ratio_in_common(variant.sums(), played.bvh().sums()), {},
               fmt::format("{:.2f} ms a step",
                           median_of(variant.sums()).value / static_cast<double>(played.steps())));
  }
}

void judge_automatic(const Played& played, BenchReport& report) {
  const auto& automatic = played.variants[Played::automatic];
  const auto& best = played.best_single();
  const std::string name = played.name + ", auto over the best single culling";
  const std::string note = properties::name_of(best.culling);
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
             ratio_in_common(automatic.of_step(0), played.bvh().of_step(0)),
             wanted::first_step_over_bvh);
}

void judge_threads(const Played& played, std::uint32_t cores, BenchReport& report) {
  const bool is_asked = cores == 2 && (played.name == "rod-twist" || played.name == "kick");
  for (const auto& [alone, all] : {std::pair(std::size_t{0}, Played::bvh_of_all),
                                   std::pair(Played::automatic, Played::automatic_of_all)}) {
    report.add(fmt::format("{}, {}: one thread over {}", played.name,
                           properties::name_of(played.variants[alone].culling), cores),
               "times", ratio_in_common(played.variants[alone].sums(), played.variants[all].sums()),
               wanted_if(is_asked, wanted::two_threads_gain));
  }
}

}  // namespace

BenchReport sequences_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report("sequences");
  const std::uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
  constexpr int frames = 9, full_rounds = 15;
  const auto play = [&](const std::string& name, const corpus::Sequence& sequence,
                        bool starts_clean) {
    progress.phase(name);
    Played played{name, variants_of(cores)};
    time_sequence(name, sequence, starts_clean, settings.rounds(full_rounds), played.variants,
                  report);
    add_table_rows(played, report);
    judge_automatic(played, report);
    if (cores > 1) judge_threads(played, cores, report);
  };
  for (const auto& [scene, triangles] : scenes_timed)
    play(scene, bench_scene(scene, settings.triangles(triangles), frames), true);
  std::vector<std::string> missing;
  for (const auto& [name, sequence, starts_clean] : real_sequences(settings, missing))
    play(name, sequence, starts_clean);
  for (const auto& file : missing) report.add_no_data("a public sequence", file);
  return report;
}

}  // namespace assay::reports
