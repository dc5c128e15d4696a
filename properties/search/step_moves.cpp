// Moves of the steps of a case: of the places of its frames, and of their order.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "detector/boundary/boundary_handler.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/random.h"
#include "properties/search/moves.h"

namespace assay::properties {
namespace {

// Puts a frame before that of this number, and the view primitive of that frame with it.
void insert_frame(Case& c, std::int32_t place, Positions x) {
  const auto script = steps_of(c);
  c.frames.insert(c.frames.begin() + place, std::move(x));
  if (c.view) {
    for (auto* ends : {&c.view->q0, &c.view->q1}) {
      if (!ends->empty()) ends->insert(ends->begin() + place, (*ends)[detector::at(place)]);
    }
  }
  c.script = script;
  for (auto& step : c.script) {
    step.from += step.from >= place ? 1 : 0;
    step.to += step.to >= place ? 1 : 0;
  }
}

// Replaces the step of this number by its two parts, or by its second part alone.
void split_step(Case& c, std::size_t place, double share, bool has_first_part) {
  const auto step = steps_of(c)[place];
  const auto& x0 = c.frames[detector::at(step.from)];
  const Positions middle = x0 + share * (c.frames[detector::at(step.to)] - x0);
  std::vector<Point> views;  // in the middle: of q0, and of q1
  if (c.view) {
    for (const auto* ends : {&c.view->q0, &c.view->q1}) {
      if (ends->empty()) continue;
      const auto& from = (*ends)[detector::at(step.from)];
      const auto& to = (*ends)[detector::at(step.to)];
      auto& view = views.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) view[k] = from[k] + share * (to[k] - from[k]);
    }
  }
  const auto part = std::max(step.from, step.to);
  insert_frame(c, part, middle);
  if (!views.empty()) c.view->q0[detector::at(part)] = views[0];
  if (views.size() == 2) c.view->q1[detector::at(part)] = views[1];
  const auto from = c.script[place].from;
  c.script[place].from = part;
  if (has_first_part)
    c.script.insert(c.script.begin() + static_cast<std::ptrdiff_t>(place), {from, part, true});
}

// Changes the past of the step in focus: the same step comes after other steps, from another place,
// or in two parts. The state that a detector carries from step to step is then different.
constexpr std::size_t most_frames = 6, most_steps = 8;
void past(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (c.counted || c.ghosts) return;
  auto script = steps_of(c);
  if (c.frames.size() >= most_frames || script.size() >= most_steps) return;
  const auto place = child.focus
                         ? child.focus->step
                         : static_cast<std::size_t>(random.below(static_cast<int>(script.size())));
  const auto step = script[place];
  const auto here = script.begin() + static_cast<std::ptrdiff_t>(place);
  std::size_t before = 0;  // the number of further steps before the one in focus
  switch (random.below(8)) {
    case 0:  // a step at rest before it, taken or looked at
      script.insert(here, {step.from, step.from, random.one_in(2)});
      before = 1;
      break;
    case 1:  // the same step, and back
      script.insert(here, {{step.from, step.to, true}, {step.to, step.from, true}});
      before = 2;
      break;
    case 2: {  // a step from the same place to any other
      const auto to = static_cast<std::int32_t>(random.below(static_cast<int>(c.frames.size())));
      script.insert(here, {step.from, to, random.one_in(3)});
      before = 1;
      break;
    }
    case 3: {  // without one of the other steps
      if (script.size() < 2) return;
      const auto dropped = static_cast<std::size_t>(random.below(static_cast<int>(script.size())));
      if (dropped == place) return;
      script.erase(script.begin() + static_cast<std::ptrdiff_t>(dropped));
      if (child.focus && dropped < place) --child.focus->step;
      c.script = script;
      return;
    }
    case 4:
    case 5: {
      if (step.from == step.to) return;
      constexpr double shares[] = {0.5, 0.25, 0.75, 0.875};
      const double share = one_of(random, shares);
      const bool has_first_part = random.one_in(2);
      split_step(c, place, share, has_first_part);
      if (!child.focus) return;
      double& time = child.focus->time;
      const bool is_in_first = time <= share;
      if (is_in_first && !has_first_part) return child.focus.reset();
      child.focus->step += has_first_part && !is_in_first ? 1 : 0;
      time = is_in_first ? time / share : (time - share) / (1 - share);
      return;
    }
    case 6: {  // a step from elsewhere, which leads here or rests there
      Positions there = c.frames[detector::at(step.from)];
      const double amount = std::ldexp(greatest_of(c), -random.between(0, 4));
      const bool rigid = random.one_in(3);
      for (Eigen::Index v = 0; v < there.rows(); ++v) {
        const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
        const Eigen::RowVector3d by = amount * Eigen::RowVector3d(x, y, z);
        if (rigid && v == 0) there.rowwise() += by;
        if (!rigid) there.row(v) += by;
      }
      insert_frame(c, step.from, there);
      c.script.insert(c.script.begin() + static_cast<std::ptrdiff_t>(place),
                      {step.from, random.one_in(4) ? step.from : step.from + 1, true});
      if (child.focus) ++child.focus->step;
      return;
    }
    default:  // a step is looked at and not taken
      one_of(random, script).commit ^= true;
      c.script = script;
      return;
  }
  c.script = script;
  if (child.focus) child.focus->step += before;
}

// Adds one more step: on, or back.
void more_steps(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (c.frames.size() >= most_frames || c.counted || c.ghosts) return;
  const auto last = static_cast<std::int32_t>(c.frames.size()) - 1;
  const bool by_script = !c.script.empty();
  if (random.one_in(2)) {
    const auto to = static_cast<std::int32_t>(random.below(last + 1));
    c.frames.push_back(c.frames[detector::at(to)]);
  } else {
    const Positions way =
        c.frames[detector::at(last)] - c.frames[detector::at(last > 0 ? last - 1 : 0)];
    c.frames.push_back(c.frames.back() + (random.one_in(2) ? 1.0 : -0.5) * way);
  }
  if (by_script) c.script.push_back({last, last + 1, true});
  if (!c.view) return;
  c.view->q0.push_back(c.view->q0.back());
  if (!c.view->q1.empty()) c.view->q1.push_back(c.view->q1.back());
}

// Lets a vertex go through a ghost, or an edge through the side of one, or touch it at a time.
void onto_ghost(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (c.ghosts) return;
  const auto loops = oracle::boundary_loops(c.triangles);
  if (loops.empty()) return;
  const auto& loop = one_of(random, loops);
  const auto script = steps_of(c);
  const auto step = child.focus ? script[child.focus->step] : one_of(random, script);
  const auto& from = c.frames[detector::at(step.from)];
  const auto& to = c.frames[detector::at(step.to)];
  const auto k = static_cast<std::size_t>(random.below(static_cast<int>(loop.size())));
  const auto u = loop[k], v = loop[(k + 1) % loop.size()];
  const auto rule = one_of(random, detector::apex_rules);
  const MovingPoint apex = {detector::place_apex(rule, loop, from),
                            detector::place_apex(rule, loop, to)};
  const auto t = random.below(static_cast<int>(c.triangles.rows())), corner = random.below(3);
  const auto w = c.triangles(t, corner), x = c.triangles(t, (corner + 1) % 3);
  if (w == u || w == v) return;
  const SteppedMesh motion{from, to};
  FourPoints points;
  points.points = {motion.path(w), motion.path(v), motion.path(u), apex};
  points.first_group = 1;
  if (random.one_in(2) && x != u) {
    points.points[1] = motion.path(x);
    points.first_group = 2;
  }
  points = brought_together(random, points);
  set_path(c, step, w, points.points[0]);
}

constexpr Move of_steps[] = {
    {"steps", "one more step", MoveKind::steps, 2, more_steps},
    {"past", "other steps lead to the step in focus", MoveKind::past, 2, past},
    {"ghost", "a vertex or an edge meets a ghost", MoveKind::steps, 2, onto_ghost},
};

}  // namespace

std::span<const Move> step_moves() { return of_steps; }

}  // namespace assay::properties
