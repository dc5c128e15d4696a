// Moves of the four points of a focus, and of all coordinates alike.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/random.h"
#include "properties/search/degeneracy.h"
#include "properties/search/moves.h"

namespace assay::properties {
namespace {

// Returns a time at which something is made to happen: an end, a power of two, or next to an end.
double menu_time(Random& random, const FourPoints& q) {
  constexpr double fixed[] = {0, 1, 1, 0.5, 0.5, 0.25, 0.125, 0.75};
  switch (random.below(4)) {
    case 0: {
      const auto root = root_of(q);
      return root ? *root : 0.5;
    }
    case 1: {
      const double small = std::ldexp(1.0, -random.between(2, 40));
      return random.one_in(2) ? small : 1 - small;
    }
    default:
      return one_of(random, fixed);
  }
}

// Returns which ends may move: all, those at t = 1, one point, or one point's end.
unsigned menu_of_ends(Random& random) {
  const unsigned point = static_cast<unsigned>(random.below(4));
  switch (random.below(4)) {
    case 0:
      return all_ends_move;
    case 1:
      return 0xf0;
    case 2:
      return 0x11u << point;
    default:
      return 0x10u << point;
  }
}

DegeneracyAt any_degeneracy(Random& random, double time) {
  constexpr Degeneracy kinds[] = {
      Degeneracy::coplanar,    Degeneracy::side,      Degeneracy::side, Degeneracy::double_root,
      Degeneracy::double_root, Degeneracy::no_normal, Degeneracy::flat, Degeneracy::flat};
  const Degeneracy kind = one_of(random, kinds);
  return {kind, time, random.below(4)};
}

// Makes a move of a whole case out of a change of the four points in focus.
template <void (*change)(Random&, FourPoints&, const Focus&, const MoveContext&)>
void in_focus(Random& random, Candidate& child, const MoveContext& context) {
  if (!child.focus) return;
  FourPoints q = query_at(child.c, *child.focus);
  change(random, q, *child.focus, context);
  set_query(child.c, *child.focus, q);
}

void newton(Random& random, FourPoints& q, const Focus& focus, const MoveContext&) {
  const double time = random.one_in(3) ? focus.time : menu_time(random, q);
  std::vector<DegeneracyAt> goals = {any_degeneracy(random, time)};
  if (goals[0].kind == Degeneracy::side || random.one_in(2))
    goals.push_back({Degeneracy::coplanar, time, 0});
  if (random.one_in(2)) goals.push_back(any_degeneracy(random, time));
  const unsigned moving = goals[0].kind == Degeneracy::flat ? all_ends_move : menu_of_ends(random);
  q = moved_onto(q, goals, moving).value_or(q);
}

Point place_of(const MovingPoint& p, double t) { return between(p.t0, p.t1, t); }

// Moves one end of the path so that the point is at this place at time t.
void send(MovingPoint& p, const Point& place, double t, bool by_its_start) {
  if (t == 0 || (by_its_start && t < 1)) {
    for (std::size_t k = 0; k < 3; ++k)
      p.t0[k] = t == 0 ? place[k] : (place[k] - t * p.t1[k]) / (1 - t);
  } else {
    for (std::size_t k = 0; k < 3; ++k) p.t1[k] = p.t0[k] + (place[k] - p.t0[k]) / t;
  }
}

void meet(Random& random, FourPoints& q, const Focus&, const MoveContext&) {
  q = brought_together(random, q);
}

double neighbour(double x, int steps, Coordinates coordinates) {
  const double towards = steps > 0 ? std::numeric_limits<double>::infinity()
                                   : -std::numeric_limits<double>::infinity();
  for (int i = std::abs(steps); i > 0; --i) {
    x = coordinates == Coordinates::float32
            ? static_cast<double>(
                  std::nextafter(static_cast<float>(x), static_cast<float>(towards)))
            : std::nextafter(x, towards);
  }
  return x;
}

// Moves a coordinate by up to three units of the last place; a coordinate 0 by such units of the
// mesh's size.
void step_on_lattice(Random& random, FourPoints& q, Coordinates coordinates) {
  auto& point = one_of(random, q.points);
  auto& end = random.one_in(2) ? point.t0 : point.t1;
  double& x = one_of(random, end);
  const int count = random.between(1, 3), steps = random.one_in(2) ? count : -count;
  if (x != 0) {
    const double next = neighbour(x, steps, coordinates);
    if (std::isfinite(next)) x = next;
    return;
  }
  double size = 0;
  for (const double other : end) size = std::max(size, std::abs(other));
  const double unit = size > 0 ? size : 1;
  x = coordinates == Coordinates::float32 ? static_cast<float>(steps * 0x1p-23 * unit)
                                          : steps * 0x1p-52 * unit;
}

void ulps(Random& random, FourPoints& q, const Focus&, const MoveContext& context) {
  for (int changes = random.between(1, 4); changes > 0; --changes)
    step_on_lattice(random, q, context.contract.coordinates);
}

// Walks on the lattice of doubles or floats as long as the exact gap shrinks.
void walk(Random& random, FourPoints& q, const Focus& focus, const MoveContext& context) {
  constexpr int tries = 10;
  const double d = context.contract.separation;
  double near = nearness(gap_of(q, focus.time, d));
  for (int i = 0; i < tries; ++i) {
    FourPoints next = q;
    step_on_lattice(random, next, context.contract.coordinates);
    const double there = nearness(gap_of(next, focus.time, d));
    if (there < near) continue;
    near = there;
    q = next;
  }
}

// Rounds all coordinates to so few bits that coincidences become exact.
void grid(Random& random, Candidate& child, const MoveContext&) {
  const double greatest = greatest_of(child.c);
  if (!(greatest > 1e-300) || !(greatest < 1e300)) return;
  const int bits = random.between(2, 12);
  const double unit = std::ldexp(1.0, std::ilogb(greatest) - bits);
  for (auto& frame : child.c.frames)
    frame = frame.unaryExpr([&](double x) { return unit * std::round(x / unit); }).eval();
}

// Brings the features into one plane, at rest or moving along its normal, in both frames or in one.
void flatten(Random& random, FourPoints& q, const Focus&, const MoveContext&) {
  const auto axis = static_cast<std::size_t>(random.below(3));
  const std::size_t copied = (axis + 1) % 3;
  const int kind = random.below(4);
  const double level_0 = q.points[0].t0[axis], level_1 = q.points[0].t1[axis];
  for (auto& p : q.points) {
    if (kind == 0) {  // a plane that no two axes span
      p.t0[axis] = p.t0[copied];
      p.t1[axis] = p.t1[copied];
      continue;
    }
    if (kind != 3) p.t0[axis] = level_0;
    p.t1[axis] = kind == 1 ? level_0 : level_1;
  }
}

// Brings the features into a plane that is not that of two axes, as doubles see it: F is then noise
// of rounding, at the edge of every error bound. The features overlap in the plane throughout.
void near_a_plane(Random& random, FourPoints& q, const Focus&, const MoveContext&) {
  const double x = random.signed_unit(), y = random.signed_unit();
  const double length = std::sqrt(x * x + y * y + 1);
  Point normal = {x / length, y / length, 1 / length};
  std::rotate(normal.begin(), normal.begin() + random.below(3), normal.end());
  const bool overlaps = random.one_in(2);
  const double s = random.between(1, 3) / 4.0, u = random.between(1, 3) / 4.0;
  for (auto end : {&MovingPoint::t0, &MovingPoint::t1}) {
    const Point origin = q.points[3].*end;
    for (std::size_t i = 0; i < 3; ++i) {
      Point& p = q.points[i].*end;
      double height = 0;
      for (std::size_t k = 0; k < 3; ++k) height += normal[k] * (p[k] - origin[k]);
      for (std::size_t k = 0; k < 3; ++k) p[k] -= height * normal[k];
    }
    if (!overlaps) continue;
    auto at = [&](std::size_t i) { return q.points[i].*end; };
    q.points[0].*end = q.first_group == 1 ? between(between(at(1), at(2), s), at(3), u)
                                          : between(at(1), between(at(2), at(3), s), 1 + u);
  }
}

// Returns the points with few bits, so that the sums and products below are exact.
FourPoints of_few_bits(FourPoints q) {
  double size = 0;
  for (const auto& p : q.points) {
    for (const double x : p.t0) size = std::max(size, std::abs(x));
  }
  if (!(size > 1e-300) || !(size < 1e300)) return q;
  const double unit = std::ldexp(1.0, std::ilogb(size) - 6);
  for (double* x : numbers_of(q)) *x = unit * std::round(*x / unit);
  return q;
}

// Lets vertex and face touch without crossing, at t = s: an exact double root, as in
// generators/aims.
void graze(Random& random, FourPoints& q, const Focus&, const MoveContext&) {
  if (q.first_group != 1) return;
  q = of_few_bits(q);
  auto& [vertex, a, b, c] = q.points;
  const double s = random.one_in(2) ? 0.5 : 0.25, share = random.between(1, 4) / 4.0;
  a.t1 = a.t0;
  b.t1 = b.t0;
  const Point middle = between(a.t0, b.t0, 0.5), e = c.t0 - middle;
  const Point w = cross(b.t0 - a.t0, e);
  c.t1 = c.t0 + share * w;
  vertex.t0 = middle + 2 * s * e + s * s * share * w;
  vertex.t1 = middle + (2 * s - 1) * e + s * s * share * w;
}

// Makes two edges parallel, or a face a segment: throughout, or at one end of the step.
void align(Random& random, FourPoints& q, const Focus&, const MoveContext&) {
  q = of_few_bits(q);
  auto& [p0, p1, p2, p3] = q.points;
  constexpr double shares[] = {1, -1, 2, 0.5};
  const double share = one_of(random, shares);
  const int ends = random.below(3);
  for (auto end : {&MovingPoint::t0, &MovingPoint::t1}) {
    if ((ends == 1 && end == &MovingPoint::t0) || (ends == 2 && end == &MovingPoint::t1)) continue;
    p3.*end = q.first_group == 2 ? p2.*end + share * (p1.*end - p0.*end)
                                 : p2.*end + share * (p1.*end - p2.*end);
  }
  if (q.first_group == 2 && random.one_in(2)) {  // one edge goes through the other on its way
    const Point by = p2.t0 - p0.t0;
    for (auto* p : {&p0, &p1}) p->t1 = p->t0 + 2 * by;
    p2.t1 = p2.t0;
    p3.t1 = p3.t0;
  }
}

// Gives the features the paths of those of another case, in its size or in their own.
void transplant(Random& random, FourPoints& q, const Focus&, const MoveContext& context) {
  if (!context.other || !context.other->focus) return;
  const auto& other = *context.other->focus;
  if (other.first_group != q.first_group) return;
  const FourPoints own = q;
  q = query_at(context.other->c, other);
  if (random.one_in(3)) {  // the ends of one, the start of the other
    for (std::size_t i = 0; i < 4; ++i)
      (random.one_in(2) ? q.points[i].t0 = own.points[i].t0 : q.points[i].t1 = own.points[i].t1);
  }
}

// Brings the case to any size that the contract takes, for thresholds that are lengths.
void resize(Random& random, Candidate& child, const Contract& contract) {
  const double greatest = greatest_of(child.c);
  if (!(greatest > 0)) return;
  constexpr int widest = 60;  // in powers of two, where the contract says nothing of small lengths
  const int most = std::ilogb(contract.largest) - 1;
  const int least =
      contract.least_nonzero > 0 ? std::ilogb(contract.least_nonzero) + 2 : most - widest;
  const int exponent = random.between(std::min(least, most), most) - std::ilogb(greatest);
  for (double* x : numbers_along(child.c)) *x = std::ldexp(*x, exponent);
}

void scale(Random& random, Candidate& child, const MoveContext& context) {
  child.c.view.reset();
  if (context.contract.has_range() && random.one_in(2))
    return resize(random, child, context.contract);
  const int reach = random.one_in(3) ? 30 : 8;
  const int exponent = random.between(-reach, reach);
  const int kind = random.below(4);
  for (double* x : numbers_along(child.c, kind == 1 ? exponent & 1 : -1))
    *x = kind > 1 ? *x + std::ldexp(1.0, exponent) : std::ldexp(*x, exponent);
}

// Lets points rest, or takes a step the other way.
void rest(Random& random, FourPoints& q, const Focus&, const MoveContext&) {
  const int kind = random.below(6);
  for (std::size_t i = 0; i < 4; ++i) {
    auto& p = q.points[i];
    const bool is_first = q.in_first_group(static_cast<int>(i));
    if (kind == 0) std::swap(p.t0, p.t1);
    if (kind == 1 || (kind == 2 && is_first) || (kind == 3 && !is_first)) p.t1 = p.t0;
  }
  if (kind >= 4) {
    auto& p = one_of(random, q.points);
    p.t1 = kind == 4 ? p.t0 : one_of(random, q.points).t1;
  }
}

void shake(Random& random, Candidate& child, const MoveContext&) {
  const double greatest = greatest_of(child.c);
  if (!(greatest < 1e300)) return;
  const double amount = std::ldexp(greatest, -random.between(0, 12));
  const bool all = random.one_in(2);
  for (auto& frame : child.c.frames) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v) {
      const bool moves = all || random.one_in(4);
      for (int k = 0; k < 3; ++k) {
        const double by = random.signed_unit();
        if (moves) frame(v, k) += amount * by;
      }
    }
  }
}

constexpr Move of_features[] = {
    {"meet", "the features meet at a drawn time and place", MoveKind::features, 5, in_focus<meet>},
    {"scale", "the case is scaled by a power of two, or moved away", MoveKind::features, 2, scale},
    {"newton", "Newton steps onto one degeneracy, or onto two at once", MoveKind::features, 6,
     in_focus<newton>},
    {"ulps", "some coordinates go to neighbouring numbers", MoveKind::features, 2, in_focus<ulps>},
    {"walk", "a walk by ulps along which the gap shrinks", MoveKind::features, 2, in_focus<walk>},
    {"grid", "all coordinates are rounded to few bits", MoveKind::features, 2, grid},
    {"flatten", "the features lie in one plane", MoveKind::features, 3, in_focus<flatten>},
    {"plane", "the features lie in one plane, except for rounding", MoveKind::features, 3,
     in_focus<near_a_plane>},
    {"graze", "vertex and face touch and part again: a double root", MoveKind::features, 2,
     in_focus<graze>},
    {"align", "parallel edges, or a face without area", MoveKind::features, 2, in_focus<align>},
    {"transplant", "the features take the paths of another case", MoveKind::features, 2,
     in_focus<transplant>},
    {"rest", "points rest, or go the other way", MoveKind::features, 2, in_focus<rest>},
    {"shake", "all vertices, or some, move a little", MoveKind::features, 3, shake},
};

}  // namespace

std::span<const Move> feature_moves() { return of_features; }

FourPoints brought_together(Random& random, FourPoints q) {
  const double t = menu_time(random, q);
  constexpr double shares[] = {0, 0.25, 0.5, 0.5, 0.75, 1.0 / 3};
  const double s = one_of(random, shares), u = one_of(random, shares);
  auto at = [&](std::size_t i) { return place_of(q.points[i], t); };
  const bool by_its_start = random.one_in(4);
  if (q.first_group == 1) {
    send(q.points[0], between(between(at(1), at(2), s), at(3), u), t, by_its_start);
  } else {
    const Point where = between(at(2), at(3), u), other = at(1);
    Point place;
    for (std::size_t k = 0; k < 3; ++k) place[k] = other[k] + (where[k] - other[k]) / (1 - s);
    send(q.points[0], place, t, by_its_start);
  }
  return q;
}

}  // namespace assay::properties
