// The steps of a case. They are in a file of their own, so that a program that only runs cases
// links neither the reader nor the writer.
#include "corpus/cases/case_file.h"

namespace assay::corpus {

std::vector<CaseStep> consecutive_steps(std::size_t frames) {
  if (frames == 1) return {{0, 0, true}};
  std::vector<CaseStep> steps;
  for (std::size_t f = 1; f < frames; ++f) {
    const auto to = static_cast<std::int32_t>(f);
    steps.push_back({to - 1, to, true});
  }
  return steps;
}

std::vector<CaseStep> steps_of(const Case& c) {
  return c.script.empty() ? consecutive_steps(c.frames.size()) : c.script;
}

const detector::Positions& start_of(const Case& c, const CaseStep& step) {
  return c.frames[static_cast<std::size_t>(step.from)];
}

const detector::Positions& end_of(const Case& c, const CaseStep& step) {
  return c.frames[static_cast<std::size_t>(step.to)];
}

std::optional<detector::ViewPrimitive> view_of_step(const Case& c, std::size_t step) {
  const auto steps = steps_of(c);
  if (!c.view || step >= steps.size()) return std::nullopt;
  const auto moving = [&](const std::vector<detector::Point>& places) {
    return detector::MovingPoint{places[static_cast<std::size_t>(steps[step].from)],
                                 places[static_cast<std::size_t>(steps[step].to)]};
  };
  const detector::MovingPoint q0 = moving(c.view->q0);
  return detector::ViewPrimitive{q0, c.view->q1.empty() ? q0 : moving(c.view->q1)};
}

Case case_of_step(const detector::Triangles& triangles, const detector::CountedPairs* counted,
                  const detector::Positions* rest, const detector::Positions& x_t0,
                  const detector::Positions& x_t1) {
  Case c;
  c.triangles = triangles;
  if (rest) c.frames.push_back(*rest);
  c.frames.push_back(x_t0);
  c.frames.push_back(x_t1);
  if (rest) c.script = {{1, 2, true}};
  if (counted) c.counted = CaseRelation{*counted, {}};
  return c;
}

std::vector<detector::Point> points_of(const detector::Positions& x) {
  std::vector<detector::Point> points;
  for (std::int32_t v = 0; v < x.rows(); ++v) points.push_back(detector::point_of(x, v));
  return points;
}

}  // namespace assay::corpus
