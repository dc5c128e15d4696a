// Moves of a view primitive, or of a mesh, that change which triangles have which sign.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "detector/mesh/topology.h"
#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/random.h"
#include "properties/search/degeneracy.h"
#include "properties/search/moves.h"

namespace assay::properties {
namespace {
using Row = Eigen::RowVector3d;

Row any_row(Random& random) {
  const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
  return {x, y, z};
}

// Gives the case a view primitive that moves on in each frame.
void see_from(Case& c, const Row& q0, const Row& q1, const Row& way, bool is_line) {
  c.view.emplace();
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    const Row a = q0 + static_cast<double>(f) * way, b = q1 + static_cast<double>(f) * way;
    c.view->q0.push_back({a[0], a[1], a[2]});
    if (is_line) c.view->q1.push_back({b[0], b[1], b[2]});
  }
}

// Gives the case a view primitive near the features or in the middle, or none.
void view(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  c.view.reset();
  if (c.ghosts || random.one_in(4)) return;
  const auto& first = c.frames.front();
  const double size = greatest_of(c);
  const Row middle = first.colwise().mean();
  const bool is_line = random.one_in(2), moves = random.one_in(3), at_vertex = random.one_in(3);
  const auto vertex = random.below(static_cast<int>(first.rows()));
  const double reach = std::ldexp(size, -random.between(0, 5));
  Row q0 = at_vertex ? Row(first.row(vertex)) : middle;
  q0 += reach * any_row(random);
  const Row q1 = q0 + size * any_row(random),
            way = moves ? Row(reach * any_row(random)) : Row(0, 0, 0);
  see_from(c, q0, q1, way, is_line);
}

// Moves a view primitive and a triangle by Newton steps onto degeneracies of the view polynomial: F
// of an end of the primitive and the three corners, which is zero where the triangle has no sign.
// This makes signs that hold only at the ends of a step, and signs that are zero once.
void look_aside(Random& random, Candidate& child, const MoveContext& context) {
  auto& c = child.c;
  if (c.ghosts || c.triangles.rows() == 0) return;
  if (!c.view) view(random, child, context);
  if (!c.view) return;
  const auto script = steps_of(c);
  const auto step = child.focus ? script[child.focus->step] : one_of(random, script);
  const auto from = detector::at(step.from), to = detector::at(step.to);
  auto triangle = random.below(static_cast<int>(c.triangles.rows()));
  if (child.focus && child.focus->contact && random.one_in(2)) {
    const auto& pair = child.focus->contact->pair;
    triangle = random.one_in(2) ? pair.a : pair.b;
  }
  const SteppedMesh motion{c.frames[from], c.frames[to]};
  const bool from_its_end = !c.view->q1.empty() && random.one_in(2);
  auto& q = from_its_end ? c.view->q1 : c.view->q0;
  FourPoints points;
  points.first_group = 1;
  points.points[0] = {q[from], q[to]};
  for (int k = 0; k < 3; ++k)
    points.points[static_cast<std::size_t>(k + 1)] = motion.path(c.triangles(triangle, k));
  constexpr double times[] = {0.5, 0.5, 0.25, 0.75, 0.125, 1.0 / 3, 0.0, 1.0};
  const double time = one_of(random, times);
  std::vector<DegeneracyAt> goals = {
      {random.one_in(2) ? Degeneracy::double_root : Degeneracy::coplanar, time, 0}};
  if (random.one_in(3)) goals.push_back({Degeneracy::coplanar, one_of(random, times), 0});
  // The primitive, a corner, or both; points at rest stay so in half of the cases.
  const unsigned masks[] = {0x01, 0x10, 0x11, 0xe0, 0xf0, 0x20, 0xff, 0xee};
  const auto points_moved = moved_onto(points, goals, one_of(random, masks));
  if (!points_moved) return;
  q[from] = points_moved->points[0].t0;
  q[to] = points_moved->points[0].t1;
  for (int k = 0; k < 3; ++k)
    set_path(c, step, c.triangles(triangle, k), points_moved->points[detector::at(k + 1)]);
}

struct Side {
  Row corner, normal;  // of length 1
};

// Returns a place from which all sides face away, the nearest or a farther one; nothing if doubles
// find none soon. The perceptron's rule gives a direction on whose side all normals lie.
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
    const auto worst = std::ranges::min_element(
        sides, [&](const Side& a, const Side& b) { return cosine(a) < cosine(b); });
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

// Sets a view primitive that the pair in focus, all pairs that meet first, or the whole mesh faces
// or faces away from, at both ends of the step and at some places between. If the primitive moves,
// this holds in each frame. Pairs then meet only because a triangle turns on the way, or because a
// ghost is touched (L4, L11).
void face_away(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (c.ghosts || !child.focus || c.triangles.rows() == 0) return;
  const auto step = steps_of(c)[child.focus->step];
  const auto [a, b] = pair_in_focus(c, *child.focus);
  std::vector<std::int32_t> triangles = {a, b};
  const int kind = random.below(4);
  if (kind < 2) {
    for (const auto& pair : child.focus->pairs) triangles.insert(triangles.end(), {pair.a, pair.b});
  } else if (kind == 2) {
    triangles.resize(static_cast<std::size_t>(c.triangles.rows()));
    std::iota(triangles.begin(), triangles.end(), 0);
  }
  const double side = random.one_in(4) ? -1 : 1;  // they face it, or away from it
  const auto sides_of = [&](const Positions& x, std::vector<Side>& sides) {
    for (const auto t : triangles) {
      const Row p = x.row(c.triangles(t, 0)), q = x.row(c.triangles(t, 1)),
                r = x.row(c.triangles(t, 2));
      const Row normal = (q - p).cross(r - p);
      const double length = normal.norm();
      if (length > 0 && std::isfinite(length)) sides.push_back({p, side * normal / length});
    }
  };
  const auto& from = c.frames[detector::at(step.from)];
  const auto& to = c.frames[detector::at(step.to)];
  std::vector<Row> places;
  if (random.one_in(3)) {  // the view moves, and is behind them in each frame
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
  const Row way = any_row(random);
  const Row along = std::ldexp(greatest_of(c), -random.between(0, 6)) * way;
  c.view.emplace();
  for (const auto& q : places) {
    c.view->q0.push_back({q[0], q[1], q[2]});
    const Row end = q + along;
    if (is_line) c.view->q1.push_back({end[0], end[1], end[2]});
  }
}

// A way of a vertex through a triangle, along a ray of a view-point from which the triangle and all
// those of the vertex are seen from one side.
struct Ray {
  std::int32_t vertex = 0;
  Row from, way, view;  // `way` leads onto the triangle
  double farthest = 0;  // how often `way` fits before the view-point
};

std::optional<Ray> any_ray(Random& random, const Case& c, const Positions& x,
                           const std::vector<std::int32_t>& component) {
  const auto count = static_cast<int>(c.triangles.rows());
  const int own = random.below(count), other = random.below(count), corner = random.below(3);
  const auto v = c.triangles(own, corner);
  const auto has_vertex = [&](int t) { return (c.triangles.row(t).array() == v).any(); };
  if (component[detector::at(own)] != component[detector::at(other)] || has_vertex(other))
    return std::nullopt;
  double s = random.unit(), u = random.unit();
  if (s + u > 1) {
    s = 1 - s;
    u = 1 - u;
  }
  const auto row = [&](int t, int k) { return Row(x.row(c.triangles(t, k))); };
  const Row goal =
      row(other, 0) + s * (row(other, 1) - row(other, 0)) + u * (row(other, 2) - row(other, 0));
  Ray ray{v, x.row(v), goal - Row(x.row(v)), {}, 1e300};
  if (!(ray.way.norm() > 0)) return std::nullopt;
  constexpr double farther[] = {0.0625, 0.25, 0.5, 1, 2, 8};
  const double away = one_of(random, farther);
  const bool is_behind = random.one_in(2);  // the view is behind the vertex, or behind the triangle
  ray.view = is_behind ? Row(ray.from - away * ray.way) : Row(goal + away * ray.way);
  if (!is_behind) ray.farthest = 1 + away / 2;
  bool is_positive = true, is_negative = true;
  for (int t = 0; t < count; ++t) {
    if (t != other && !has_vertex(t)) continue;
    const Row p = row(t, 0);
    const double value = (row(t, 1) - p).cross(row(t, 2) - p).dot(p - ray.view);
    is_positive &= value > 0;
    is_negative &= value < 0;
  }
  return is_positive || is_negative ? std::optional(ray) : std::nullopt;
}

// Moves the view primitive, at one time, into the plane of one of the triangles that meet first, as
// computed in doubles: then only rounding errors decide the sign of the triangle.
void put_into_a_plane(Random& random, Candidate& child) {
  auto& c = child.c;
  const auto step = steps_of(c)[child.focus->step];
  const auto& x0 = c.frames[detector::at(step.from)];
  const auto& x1 = c.frames[detector::at(step.to)];
  const auto& pair = one_of(random, child.focus->pairs);
  const auto t = random.one_in(2) ? pair.a : pair.b;
  constexpr double times[] = {0, 0, 1, 1, 0.5, 0.25};
  const double time = one_of(random, times);
  const auto corner = [&](int k) {
    const auto v = c.triangles(t, k);
    return Row(x0.row(v) + time * (x1.row(v) - x0.row(v)));
  };
  const Row p = corner(0), normal = (corner(1) - p).cross(corner(2) - p);
  if (!(normal.squaredNorm() > 0)) return;
  const auto q = [&](std::int32_t frame) {
    const auto [a, b, d] = c.view->q0[detector::at(frame)];
    return Row(a, b, d);
  };
  const Row seen_from = q(step.from) + time * (q(step.to) - q(step.from));
  const Row by = (p - seen_from).dot(normal) / normal.squaredNorm() * normal;
  for (auto* ends : {&c.view->q0, &c.view->q1}) {
    for (auto& end : *ends) end = {end[0] + by[0], end[1] + by[1], end[2] + by[2]};
  }
}

// Chooses, among some view primitives, the one that sees the first contacts the most alike.
void gaze(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (c.ghosts || !child.focus || child.focus->pairs.empty()) return;
  const auto step = steps_of(c)[child.focus->step];
  const auto& x = c.frames[detector::at(step.from)];
  const Row place = x.row(child.focus->vertices[0]);
  const double size = (x.rowwise() - place).cwiseAbs().maxCoeff();
  if (!(size > 0)) return;
  const auto draw = [&](double reach) { return Row(reach * any_row(random)); };
  const bool is_line = !random.one_in(3), moves = random.one_in(4);
  auto best = c.view;
  const bool is_within = is_within_a_component(c, *child.focus);
  const auto alike_now = [&] { return is_within ? seen_alike(c, *child.focus) : 0; };
  double most = best ? alike_now() : 0;
  constexpr int tries = 16;
  for (int i = 0; i < tries; ++i) {
    const double reach = std::ldexp(size, random.between(-4, 2));
    const bool goes_on = best && !best->q1.empty() == is_line && random.one_in(2);
    const auto& old = goes_on ? best->q0.front() : Point{};
    const Row q = (goes_on ? Row(old[0], old[1], old[2]) : place) + draw(reach);
    const Row end = q + draw(std::ldexp(size, random.between(-3, 2)));
    const Row way = moves ? draw(reach) : Row(Row::Zero());
    see_from(c, q, end, way, is_line);
    const double alike = alike_now();
    if (alike < most) continue;
    most = alike;
    best = c.view;
  }
  c.view = best;
  if (best && random.one_in(3)) put_into_a_plane(random, child);
}

constexpr Move of_views[] = {
    {"view", "another view primitive", MoveKind::view, 2, view},
    {"aside", "Newton steps of a view primitive and a triangle", MoveKind::view, 4, look_aside},
    {"away", "a view primitive from which the triangles in focus face away", MoveKind::view, 5,
     face_away},
    {"gaze", "a view primitive, out of several, that makes the first contacts look most alike",
     MoveKind::view, 5, gaze},
    {"ray", "a vertex goes through a triangle along a ray of a view-point", MoveKind::view, 5,
     pass_by_ray},
};

}  // namespace

std::span<const Move> view_moves() { return of_views; }

void pass_by_ray(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (c.ghosts || c.counted || c.triangles.rows() < 2) return;
  const auto script = steps_of(c);
  const auto step = child.focus ? script[child.focus->step] : one_of(random, script);
  if (step.from == step.to) return;
  const auto& x = c.frames[detector::at(step.from)];
  const auto component =
      detector::make_topology(c.triangles, c.frames.front().rows()).component_of_triangle;
  std::optional<Ray> best;
  constexpr int most_tries = 100, enough = 3;
  for (int tries = 0, hits = 0; tries < most_tries && hits < enough; ++tries) {
    const auto ray = any_ray(random, c, x, component);
    if (!ray) continue;
    ++hits;
    if (!best || ray->way.norm() < best->way.norm()) best = ray;
  }
  if (!best) return;
  constexpr double times[] = {1, 0.5, 0.5, 0.75, 0.9375};
  const double along = std::min(1 / one_of(random, times), best->farthest);
  const bool others_move = random.one_in(4);
  auto& to = c.frames[detector::at(step.to)];
  for (Eigen::Index i = 0; i < to.rows(); ++i) {
    const double share = others_move ? std::ldexp(random.signed_unit(), -3) : 0;
    to.row(i) = x.row(i) + share * (x.row(i) - best->view);
  }
  to.row(best->vertex) = best->from + along * best->way;
  const Row& q = best->view;
  c.view.emplace();
  c.view->q0.assign(c.frames.size(), {q[0], q[1], q[2]});
  if (random.one_in(4)) {
    const Row end = q + std::ldexp(1.0, -random.between(1, 20)) * best->way;
    c.view->q1.assign(c.frames.size(), {end[0], end[1], end[2]});
  }
  child.focus.reset();
}

}  // namespace assay::properties
