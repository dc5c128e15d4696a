// Moves that decide on what a culling by views rests: what a mesh is seen from, which triangles are
// of one component with which, and what its ghosts touch.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "detector/boundary/apex.h"
#include "oracle/mesh/loops.h"
#include "properties/reducer/case_edits.h"
#include "properties/search/moves.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using detector::FourPoints;
using detector::Point;
using Row = Eigen::RowVector3d;

struct Side {
  Row corner, normal;  // of length 1
};

// A place from which all sides face away, as near as may be or farther; nothing if doubles find
// none soon. It follows from the perceptron's rule a way on which all normals lie.
std::optional<Row> place_behind(Random& random, const std::vector<Side>& sides) {
  constexpr int most_tries = 24;
  constexpr double least_cosine = 0x1p-6;
  Row middle = Row::Zero(), way = Row::Zero();
  for (const auto& side : sides) {
    middle += side.corner / static_cast<double>(sides.size());
    way += side.normal;
  }
  const auto cosine = [&](const Side& side) { return way.dot(side.normal); };
  for (int tries = 0;; ++tries) {
    const double length = way.norm();
    if (!(length > 0) || tries == most_tries) return std::nullopt;
    way /= length;
    const auto worst =
        std::min_element(sides.begin(), sides.end(),
                         [&](const Side& a, const Side& b) { return cosine(a) < cosine(b); });
    if (cosine(*worst) > least_cosine) break;
    way += worst->normal;
  }
  double least = -std::numeric_limits<double>::infinity(), size = 0;
  for (const auto& side : sides) {
    least = std::max(least, (middle - side.corner).dot(side.normal) / cosine(side));
    size = std::max(size, (middle - side.corner).norm());
  }
  constexpr double farther[] = {0, 0x1p-20, 0x1p-4, 0.5, 2};
  return Row(middle - (least + one_of(random, farther) * size) * way);
}

// The pair in contact; else two triangles of which each holds one of the features.
detector::TrianglePair pair_in_focus(const corpus::Case& c, const Focus& focus) {
  if (focus.contact) return focus.contact->pair;
  const auto holder = [&](std::int32_t vertex) {
    std::int32_t t = 0;
    while (t + 1 < c.triangles.rows() && !(c.triangles.row(t).array() == vertex).any()) ++t;
    return t;
  };
  return {holder(focus.vertices.front()), holder(focus.vertices.back())};
}

// A view primitive from which the pair in focus, or the whole mesh, faces away at both ends of
// the step and at some places between. What meets nevertheless, meets because a triangle turns on
// the way, or because a ghost is touched (L4, L11).
void face_away(Random& random, Candidate& made, const MoveContext&) {
  auto& c = made.c;
  if (c.ghosts || !made.focus || c.triangles.rows() == 0) return;
  const auto step = corpus::steps_of(c)[made.focus->step];
  const auto [a, b] = pair_in_focus(c, *made.focus);
  std::vector<std::int32_t> triangles = {a, b};
  if (random.one_in(3)) {
    triangles.resize(static_cast<std::size_t>(c.triangles.rows()));
    for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] = static_cast<std::int32_t>(t);
  }
  const auto sides_of = [&](const detector::Positions& x, std::vector<Side>& sides) {
    for (const auto t : triangles) {
      const Row p = x.row(c.triangles(t, 0)), q = x.row(c.triangles(t, 1)),
                r = x.row(c.triangles(t, 2));
      const Row normal = (q - p).cross(r - p);
      const double length = normal.norm();
      if (length > 0 && std::isfinite(length)) sides.push_back({p, normal / length});
    }
  };
  const auto& from = c.frames[detector::at(step.from)];
  const auto& to = c.frames[detector::at(step.to)];
  std::vector<Row> places;
  if (random.one_in(3)) {  // it moves, and is behind them in each frame
    for (const auto& x : c.frames) {
      std::vector<Side> sides;
      sides_of(x, sides);
      const auto place = place_behind(random, sides);
      if (!place) return;
      places.push_back(*place);
    }
  } else {
    std::vector<Side> sides;
    sides_of(from, sides);
    sides_of(to, sides);
    constexpr int most_between = 3;
    for (int between = random.below(most_between + 1), i = 1; i <= between; ++i)
      sides_of(from + i / (between + 1.0) * (to - from), sides);
    const auto place = place_behind(random, sides);
    if (!place) return;
    places.assign(c.frames.size(), *place);
  }
  const bool is_line = random.one_in(2);
  const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
  const Row along = std::ldexp(greatest_of(c), -random.between(0, 6)) * Row(x, y, z);
  c.view.emplace();
  for (const auto& q : places) {
    c.view->q0.push_back({q[0], q[1], q[2]});
    const Row end = q + along;
    if (is_line) c.view->q1.push_back({end[0], end[1], end[2]});
  }
}

// Two triangles between an edge of each of the two in focus: they are of one component then, or
// joined once more, and the mesh has other loops.
void bridge(Random& random, Candidate& made, const MoveContext&) {
  auto& c = made.c;
  if (c.counted || c.ghosts || !made.focus || c.triangles.rows() < 2) return;
  const auto count = static_cast<int>(c.triangles.rows());
  const auto [a, b] = pair_in_focus(c, *made.focus);
  const auto loops = oracle::unmatched_edges(c.triangles);
  const std::set<oracle::DirectedEdge> open(loops.begin(), loops.end());
  const auto edge_of = [&](int t) {
    oracle::DirectedEdge edge{};
    const int first = random.below(3);
    for (int k = first; k < first + 3; ++k) {
      edge = {c.triangles(t, k % 3), c.triangles(t, (k + 1) % 3)};
      if (open.contains(edge)) break;
    }
    return edge;
  };
  const auto [u, v] = edge_of(a);
  const auto [x, y] = edge_of(b);
  corpus::Case joined = c;
  joined.triangles.conservativeResize(count + 2, 3);
  joined.triangles.row(count) << v, u, y;
  joined.triangles.row(count + 1) << v, y, x;
  if (is_valid(joined)) c = std::move(joined);
}

// Lets a vertex go through a ghost, or an edge through the side of one, or touch it at a time.
void onto_ghost(Random& random, Candidate& made, const MoveContext&) {
  auto& c = made.c;
  if (c.ghosts) return;
  const auto loops = oracle::boundary_loops(c.triangles);
  if (loops.empty()) return;
  const auto& loop = one_of(random, loops);
  const auto script = corpus::steps_of(c);
  const auto step = made.focus ? script[made.focus->step] : one_of(random, script);
  auto& from = c.frames[detector::at(step.from)];
  auto& to = c.frames[detector::at(step.to)];
  const auto k = static_cast<std::size_t>(random.below(static_cast<int>(loop.size())));
  const auto u = loop[k], v = loop[(k + 1) % loop.size()];
  const auto rule = one_of(random, detector::apex_rules);
  const detector::MovingPoint apex = {detector::place_apex(rule, loop, from),
                                      detector::place_apex(rule, loop, to)};
  const auto t = random.below(static_cast<int>(c.triangles.rows())), corner = random.below(3);
  const auto w = c.triangles(t, corner), x = c.triangles(t, (corner + 1) % 3);
  if (w == u || w == v) return;
  const detector::SteppedMesh motion{from, to};
  FourPoints points;
  points.points = {motion.path(w), motion.path(v), motion.path(u), apex};
  points.first_group = 1;
  if (random.one_in(2) && x != u) {
    points.points[1] = motion.path(x);
    points.first_group = 2;
  }
  points = brought_together(random, points);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    from(w, axis) = points.points[0].t0[static_cast<std::size_t>(axis)];
    to(w, axis) = points.points[0].t1[static_cast<std::size_t>(axis)];
  }
}

constexpr Move of_sides[] = {
    {"away", "a view primitive from which the two in focus face away at both ends of the step",
     true, 5, face_away, true},
    {"bridge", "two triangles join the two in focus", true, 2, bridge},
    {"ghost", "a vertex or an edge meets a ghost", true, 2, onto_ghost},
};

}  // namespace

std::span<const Move> side_moves() { return of_sides; }

}  // namespace assay::properties
