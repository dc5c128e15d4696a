#include "properties/campaign/explicit_view.h"

#include "detector/detector.h"

namespace assay::properties {

std::optional<corpus::Case> with_explicit_view(const corpus::Case& c,
                                               const detector::Options& options) {
  const bool is_line = options.culling == detector::Culling::view_line;
  if (c.view || (!is_line && options.culling != detector::Culling::view_point)) {
    return std::nullopt;
  }
  auto made = detector::Detector::create(c.triangles, c.frames[0], options);
  if (!made) return std::nullopt;
  corpus::Case out = c;
  out.view.emplace();
  // A primitive is a function of one frame's positions: a step that stays there shows it.
  for (const auto& frame : c.frames) {
    const auto result = made.value().evaluate(frame, frame);
    if (result.primitives.empty()) return std::nullopt;
    out.view->q0.push_back(result.primitives[0].q0.t0);
    if (is_line) out.view->q1.push_back(result.primitives[0].q1.t0);
  }
  return out;
}

Finding finding_of(const Failure& failure) {
  Finding finding;
  finding.signature = failure.signature();
  finding.step = failure.step;
  if (failure.pair) finding.focus = {failure.pair->a, failure.pair->b};
  return finding;
}

}  // namespace assay::properties
