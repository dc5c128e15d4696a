#include "reports/bench/detector/detector_suite.h"

#include <algorithm>

#include "corpus/scenes/scenes.h"
#include "reports/bench/detector/sequence_run.h"
#include "reports/bench/real_sequences.h"
#include "reports/bench/speed_error/error_families.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

SequenceToCompare to_compare(std::string name, std::string kind, corpus::Sequence sequence,
                             bool starts_clean, int rounds) {
  SequenceToCompare out;
  out.c.id = std::move(name);
  out.c.triangles = std::move(sequence.triangles);
  out.c.frames = std::move(sequence.frames);
  out.kind = std::move(kind);
  out.starts_clean = starts_clean;
  out.rounds = rounds;
  return out;
}

}  // namespace

BenchReport detector_suite(const BenchSettings& settings, const BenchedPlugin& plugin,
                           Progress& progress) {
  constexpr int rounds_of_scenes = 5, rounds_of_real = 3;
  constexpr Eigen::Index most_triangles_when_quick = 10'000;
  const bool is_quick = settings.scale < 1;
  BenchReport report("detector");
  ComparedWorkers workers(plugin);
  const auto add = [&](const SequenceToCompare& sequence) {
    progress.phase(sequence.c.id);
    report.sequences.push_back(
        workers.compare(sequence, report.wrong_answers, [&] { progress.tick(); }));
  };
  for (const auto& scene : corpus::scenes()) {
    const std::string name(scene.name);
    add(to_compare(name, "scene",
                   around_first_contact(bench_scene(name, settings.triangles(scene.default_size),
                                                    scene.default_frames)),
                   scene.closed, settings.rounds(rounds_of_scenes)));
  }
  std::vector<std::string> missing;
  for (auto& real : real_sequences(settings, missing)) {
    if (is_quick && real.frames.triangles.rows() > most_triangles_when_quick) {
      report.add_left_out(real.name, "left out: of more triangles than --quick takes");
      continue;
    }
    add(to_compare(real.name, "real", std::move(real.frames), real.starts_clean,
                   settings.rounds(rounds_of_real)));
  }
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  const auto& about = plugin.description;
  report.detector = ComparedDetector{
      about.name,     about.version,       plugin.library,       claims_on_steps(about),
      about.contract, workers.isolation(), plugin.limits.threads};
  return report;
}

}  // namespace assay::reports
