// Suite `claims`: what the thesis says of costs, and DESIGN's rows on whole steps.
#include <filesystem>

#include "corpus/scenes.h"
#include "reports/bench/claims_parts.h"
#include "reports/bench/contact_step.h"
#include "reports/bench/real_sequences.h"

namespace assay::reports {
namespace {

bool exists(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

// The bunny as it is bent into a ring: the first of six steps.
std::optional<NamedStep> bent_bunny(const BenchSettings& settings) {
  const std::string file = settings.file("ipc-toolkit/bunny.ply");
  if (!exists(file)) return std::nullopt;
  auto mesh = corpus::read_mesh(file);
  if (!mesh) throw UnusableData(mesh.error().message);
  auto scene = corpus::make_scene("bend", {0, 6, std::move(mesh.value())});
  if (!scene) throw UnusableData(scene.error().message);
  scene.value().frames.resize(2);
  return NamedStep{"bunny", std::move(scene.value())};
}

}  // namespace

BenchReport claims_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report;
  report.suite = "claims";
  progress.phase("steps");
  std::vector<NamedStep> steps;
  for (const std::string scene : {"dented-sphere", "crumpling-sphere", "bend"}) {
    auto step = step_at_first_contact(scene, settings.triangles(20'000));
    if (step) steps.push_back({scene, std::move(*step)});
  }
  if (auto step = bent_bunny(settings)) {
    steps.push_back(std::move(*step));
  } else {
    report.add_no_data("bunny", settings.file("ipc-toolkit/bunny.ply"));
  }
  auto rods = rod_twist_step(settings);
  const bool has_rod_twist = rods.has_value();
  if (has_rod_twist) {
    steps.push_back({"rod-twist", std::move(*rods)});
  } else {
    report.add_no_data("rod-twist", settings.file("scalable-ccd/rod-twist/frames"));
  }
  progress.phase("box tests");
  measure_search(steps, settings, report);
  progress.phase("traditional scheme");
  compare_with_traditional(steps, settings, report);
  progress.phase("thesis as printed");
  measure_as_printed(settings, report);
  progress.phase("marking");
  measure_marking(settings, report);
  progress.phase("unclosed meshes");
  compare_on_unclosed_data(settings, report);
  progress.phase("free steps");
  count_traversals_of_free_steps(settings, report);
  progress.phase("whole steps");
  time_whole_steps(steps, has_rod_twist, settings, report);
  measure_break_even(settings, progress, report);
  return report;
}

}  // namespace assay::reports
