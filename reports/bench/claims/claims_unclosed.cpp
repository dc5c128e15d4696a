// On public sequences of unclosed meshes: what view-auto tests and how long it takes, compared
// with bvh.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "detector/detector.h"
#include "reports/bench/claims/claims_parts.h"
#include "reports/bench/interleave.h"
#include "reports/bench/same_answers.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

// What was counted and measured over a sequence.
struct Played {
  std::vector<StepResult> steps;
  double ns = 0;  // of all steps, without preprocessing
  std::uint64_t candidates = 0;
  std::size_t steps_with_views = 0, most_against_all = 0;
};

// Plays the sequence through a new detector with default options, as `assay check` does: the start
// is verified, all pairs are asked for, and arithmetic is exact. Each step is committed.
Played play(const corpus::Sequence& sequence, Culling culling) {
  Options options;
  options.culling = culling;
  auto made = Detector::create(sequence.triangles, sequence.frames[0], options);
  if (!made) throw UnusableData(made.error().message);
  Played played;
  played.ns = ns_of([&] {
    for (std::size_t f = 0; f + 1 < sequence.frames.size(); ++f) {
      played.steps.push_back(made.value().step(sequence.frames[f], sequence.frames[f + 1]));
    }
  });
  for (const auto& step : played.steps) {
    played.candidates += step.counts.search.candidate_pairs;
    played.steps_with_views += step.doubts.empty() ? 0 : 1;
    played.most_against_all = std::max(played.most_against_all, step.against_all);
  }
  return played;
}

void compare(const std::string& name, const corpus::Sequence& sequence, int rounds,
             BenchReport& report) {
  Played of_auto, of_bvh;
  const auto samples =
      interleave(rounds, {[&] { return (of_auto = play(sequence, Culling::view_auto)).ns; },
                          [&] { return (of_bvh = play(sequence, Culling::bvh)).ns; }});
  const auto steps = of_bvh.steps.size();
  const double per_step = 1e-6 / static_cast<double>(steps);
  for (std::size_t s = 0; s < steps; ++s) {
    check_same_pairs(fmt::format("{}, step {}", name, s + 1), of_auto.steps[s], of_bvh.steps[s],
                     report);
  }
  report.add(fmt::format("unclosed, {}, bvh", name), "ms a step",
             scaled(median_of(samples[1]), per_step), {},
             fmt::format("{} triangles, {} steps", sequence.triangles.rows(), steps));
  report.add(fmt::format("unclosed, {}, view-auto", name), "ms a step",
             scaled(median_of(samples[0]), per_step), {},
             fmt::format("{} of {} steps use views; Vv {} at most", of_auto.steps_with_views, steps,
                         of_auto.most_against_all));
  report.add(
      fmt::format("unclosed, {}: candidates over bvh's, view-auto", name), "times",
      exactly(static_cast<double>(of_auto.candidates) / static_cast<double>(of_bvh.candidates)), {},
      fmt::format("{} over {}", of_auto.candidates, of_bvh.candidates));
  // If views do not pay, they may cost no more than a look at whether they do.
  report.add(fmt::format("unclosed, {}: time over bvh's, view-auto", name), "times",
             ratio_of(samples[0], samples[1]), wanted::view_auto_over_bvh);
}

}  // namespace

void compare_on_unclosed_data(const BenchSettings& settings, BenchReport& report) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> sequences = {
      {"thick-cloth", {"ipc-toolkit/thick-cloth/t0.ply", "ipc-toolkit/thick-cloth/t1.ply"}},
      {"codim-ipc-kick",
       {"codim-ipc-kick/shell56.obj.gz", "codim-ipc-kick/shell57.obj.gz",
        "codim-ipc-kick/shell58.obj.gz", "codim-ipc-kick/shell59.obj.gz",
        "codim-ipc-kick/shell60.obj.gz", "codim-ipc-kick/shell61.obj.gz",
        "codim-ipc-kick/shell62.obj.gz"}}};
  for (const auto& [name, files] : sequences) {
    std::vector<std::filesystem::path> paths;
    for (const auto& file : files) paths.emplace_back(settings.file(file));
    std::error_code ignored;
    const auto missing = std::find_if(paths.begin(), paths.end(), [&](const auto& path) {
      return !std::filesystem::exists(path, ignored);
    });
    if (missing != paths.end()) {
      report.add_no_data("unclosed, " + name, missing->string());
      continue;
    }
    const auto sequence = corpus::read_sequence(paths);
    if (!sequence) throw UnusableData(sequence.error().message);
    compare(name, sequence.value(), settings.rounds(9), report);
  }
}

}  // namespace assay::reports
