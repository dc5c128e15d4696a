#include "properties/campaign/phases/explicit_view.h"

#include "detector/detector.h"

namespace assay::properties {

std::optional<corpus::Case> with_explicit_view(const corpus::Case& c,
                                               const detector::Options& options) {
  if (c.view || !uses_views(options.culling)) return std::nullopt;
  auto made = detector::Detector::create(c.triangles, c.frames[0], options);
  if (!made) return std::nullopt;
  corpus::Case out = c;
  out.view.emplace();
  bool is_line = options.culling == detector::Culling::view_line;
  // A primitive depends on the positions of one frame alone, so a step that stays in that frame
  // shows it.
  for (const auto& frame : c.frames) {
    const auto result = made.value().evaluate(frame, frame);
    if (result.primitives.empty()) return std::nullopt;
    is_line |= out.view->q0.empty() && !result.primitives[0].is_point();  // as view-auto chose
    out.view->q0.push_back(result.primitives[0].q0.t0);
    if (is_line) out.view->q1.push_back(result.primitives[0].q1.t0);
  }
  return out;
}

Finding finding_of(const Failure& failure) {
  Finding finding;
  finding.signature = failure.signature();
  finding.step = failure.step;
  finding.explanation = failure.explanation;
  if (failure.pair) finding.focus = {failure.pair->a, failure.pair->b};
  return finding;
}

}  // namespace assay::properties
