// Suite `claims` checks what the thesis says of costs, and measures what whole steps take.
#include "reports/bench/claims/claims_parts.h"
#include "reports/bench/contact_step.h"
#include "reports/bench/real_sequences.h"

namespace assay::reports {
BenchReport claims_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report("claims");
  progress.phase("steps");
  std::vector<NamedStep> steps;
  for (const std::string scene : {"dented-sphere", "crumpling-sphere", "bend"}) {
    auto step = step_at_first_contact(scene, settings.triangles(20'000));
    if (step) steps.push_back({scene, std::move(*step)});
  }
  if (auto bunny = bent_bunny(settings)) {
    bunny->frames.resize(2);
    steps.push_back({"bunny", std::move(*bunny)});
  } else {
    report.add_no_data("bunny", bunny_file(settings));
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
