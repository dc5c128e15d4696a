// Suite `sequences` times whole sequences with each culling, and with several threads.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>

#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using namespace detector;

constexpr const char* scenes_timed[] = {"breathing-sphere",
                                        "two-spheres",
                                        "dented-sphere",
                                        "bend",
                                        "twist",
                                        "open-tube",
                                        "pinching-torus",
                                        "folding-sheet",
                                        "crumpling-sphere",
                                        "arm-in-box",
                                        "ball-in-tube",
                                        "inverted-sleeve",
                                        "crossing-fans",
                                        "winding-spiral"};

// Returns the size of a scene. Two scenes are smaller, because their contacts grow with the square
// of the triangles: at the size of the others each of their steps would take seconds.
int full_size(const std::string& scene) {
  return scene == "inverted-sleeve" ? 1'000 : scene == "winding-spiral" ? 2'000 : 10'000;
}

// Returns the single cullings, then Culling::automatic, then the subjects that use all cores.
std::vector<BenchSubject> subjects_of(std::uint32_t cores) {
  std::vector<BenchSubject> subjects;
  const auto add = [&](Culling culling, std::uint32_t threads) {
    subjects.push_back(variant_of(Arithmetic::exact, culling, Pairs::all));
    subjects.back().options.threads = threads;
  };
  for (const auto culling : {Culling::bvh, Culling::normal_cone, Culling::view_point,
                             Culling::view_line, Culling::automatic})
    add(culling, 1);
  for (const auto culling : {Culling::bvh, Culling::automatic}) add(culling, cores);
  return subjects;
}
constexpr std::size_t singles = 4, automatic = 4, bvh_of_all = 5, automatic_of_all = 6;

// Finds wrong answers: all runs must agree in answers, pairs and times of contact, and runs with
// one culling in everything that result_hash() covers, whatever their threads.
void find_differences(const Match& match, BenchReport& report) {
  std::map<std::pair<std::size_t, Culling>, std::uint64_t> hashes;
  for (std::size_t i = 0; i < match.runs.size(); ++i) {
    const auto& steps = match.runs[i].first->steps;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto &result = steps[s], &first = match.runs[0].first->steps[s];
      const auto label = fmt::format("{}, step {}", match.c.id, s + 1);
      const auto hash = result_hash(result);
      const auto of_culling = std::pair(s, match.subjects[i].configuration.options.culling);
      if (hashes.try_emplace(of_culling, hash).first->second != hash)
        report.wrong_answers.push_back(label + ": two runs with one culling differ");
      const bool same =
          result.answer == first.answer && result.first == first.first &&
          std::equal(result.pairs.begin(), result.pairs.end(), first.pairs.begin(),
                     first.pairs.end(), [](const PairContact& one, const PairContact& other) {
                       return one.pair == other.pair && one.time == other.time;
                     });
      if (!same) report.wrong_answers.push_back(label + ": two cullings find different pairs");
    }
    if (match.runs[i].has_differing_runs)
      report.wrong_answers.push_back(match.c.id + ": two runs differ");
  }
}

// Returns the ratio over the rounds in which both took part.
Estimate ratio_in_common(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t rounds = std::min(a.size(), b.size());
  return ratio_of(std::span(a).first(rounds), std::span(b).first(rounds));
}

void add_rows(const Match& match, std::uint32_t cores, BenchReport& report) {
  const auto& runs = match.runs;
  const auto steps = runs[0].first->steps.size();
  std::vector<std::vector<double>> sums;
  for (const auto& of_subject : runs) sums.push_back(of_subject.sums());
  const auto add = [&](const std::string& what, const Estimate& estimate, std::optional<Goal> goal,
                       const std::string& note) {
    report.add(match.c.id + ", " + what, "times", estimate, goal, note);
  };
  const auto culling = [&](std::size_t i) {
    return std::string(name_of(match.subjects[i].configuration.options.culling));
  };
  // All cullings over bvh, for users who want to choose by themselves.
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto threads = match.subjects[i].configuration.options.threads;
    add(fmt::format("{}, {} thread{}: time over the time of bvh", culling(i), threads,
                    threads == 1 ? "" : "s"),
        ratio_in_common(sums[i], sums[0]), {},
        fmt::format("{:.2f} ms a step", median_of(sums[i]).value / static_cast<double>(steps)));
  }
  const auto best =
      static_cast<std::size_t>(std::min_element(sums.begin(), sums.begin() + singles,
                                                [](const auto& a, const auto& b) {
                                                  return median_of(a).value < median_of(b).value;
                                                }) -
                               sums.begin());
  const std::string name = "auto over the best single culling";
  add(name + ", sum", ratio_in_common(sums[automatic], sums[best]), goal::auto_over_best_culling,
      culling(best));
  std::vector<double> ratios;
  double worst = 0;
  std::size_t worst_step = 0;
  for (std::size_t s = 0; s < steps; ++s) {
    const auto ms = runs[automatic].of_step(s);
    ratios.push_back(ratio_in_common(ms, runs[best].of_step(s)).value);
    constexpr double long_enough_ms = 1;
    if (ratios.back() > worst && median_of(ms).value >= long_enough_ms) {
      worst = ratios.back();
      worst_step = s + 1;
    }
  }
  add(name + ", median step", median_of(ratios), goal::auto_over_best_culling, culling(best));
  if (worst > 0) {
    add(name + ", worst step of 1 ms or more", exactly(worst), goal::auto_step_over_best_culling,
        fmt::format("step {}", worst_step));
  }
  add("auto over bvh, first step", ratio_in_common(runs[automatic].of_step(0), runs[0].of_step(0)),
      goal::first_step_over_bvh, "");
  if (cores == 1) return;
  const bool is_asked = cores == 2 && (match.c.id == "rod-twist" || match.c.id == "kick");
  for (const auto& [alone, all] :
       {std::pair(std::size_t{0}, bvh_of_all), std::pair(automatic, automatic_of_all)})
    add(fmt::format("{}: one thread over {} threads", culling(alone), cores),
        ratio_in_common(sums[alone], sums[all]), goal_if(is_asked, goal::two_threads_gain), "");
}

}  // namespace

BenchReport sequences_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report{"sequences"};
  std::vector<std::string> missing;
  std::vector<CaseFamily> families;
  for (const std::string name : scenes_timed) {
    constexpr int frames = 9;
    const int size = settings.triangles(full_size(name));
    families.push_back({.name = name, .kind = "scene", .cases = [=] {
                          auto scene = bench_scene(name, size, frames);
                          return std::vector{timed_case(name, std::move(scene), Start::clean)};
                        }});
  }
  for (auto& real : real_families(settings, missing)) families.push_back(std::move(real));
  constexpr int full_rounds = 15;
  for (auto& family : families) family.rounds = settings.rounds(full_rounds);
  const std::uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
  const auto subjects = subjects_of(cores);
  // A culling that takes three times as long as another one is no choice, and two rounds suffice to
  // tell how far off it is.
  ComparisonPlan plan{.sweep = {.clock = wall_ns_of, .far_off = 3}, .is_judged = false};
  plan.on_case = [&](const Match& match) {
    find_differences(match, report);
    add_rows(match, cores, report);
  };
  Comparison(subjects, plan, report, progress).run(families);
  for (const auto& file : missing) report.add_no_data("a public sequence", file);
  return report;
}

}  // namespace assay::reports
