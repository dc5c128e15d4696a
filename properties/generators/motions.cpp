#include <algorithm>
#include <cmath>

#include "corpus/scenes/shapes.h"
#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {

void breathe(Random& random, const Point& centre, Points& x, double amount) {
  for (auto& p : x) p = between(centre, p, 1 + 0.5 * amount * random.signed_unit());
}

void roughen(Random& random, Points& x, double amount) {
  for (auto& p : x) {
    for (double& c : p) c += amount / 32 * random.signed_unit();
  }
}

namespace {

void turn(Point& p, std::size_t axis, double turns) {
  double& a = p[(axis + 1) % 3];
  double& b = p[(axis + 2) % 3];
  const double c = corpus::cos_turn(turns), s = corpus::sin_turn(turns), a_before = a;
  a = c * a_before - s * b;
  b = s * a_before + c * b;
}

// Returns half the length of the mesh along an axis. It is never 0.
double reach(const Points& x, std::size_t axis) {
  double r = 0x1p-10;
  for (const auto& p : x) r = std::max(r, std::abs(p[axis]));
  return r;
}

std::size_t any_axis(Random& random) { return at(random.below(3)); }

void rigid(Random& random, const Draft&, Points& x, double amount) {
  const auto axis = any_axis(random);
  const double turns = 0.25 * amount * random.signed_unit();
  const Point by = amount * any_vector(random);
  for (auto& p : x) {
    turn(p, axis, turns);
    p = p + by;
  }
}

void affine(Random& random, const Draft&, Points& x, double amount) {
  const std::array<Point, 3> rows = {any_vector(random), any_vector(random), any_vector(random)};
  for (auto& p : x) p = p + amount * Point{dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
}

void quadratic(Random& random, const Draft&, Points& x, double amount) {
  const std::array<Point, 3> a = {any_vector(random), any_vector(random), any_vector(random)};
  const std::array<Point, 3> b = {any_vector(random), any_vector(random), any_vector(random)};
  for (auto& p : x) {
    Point by;
    for (std::size_t k = 0; k < 3; ++k) by[k] = dot(a[k], p) * dot(b[k], p);
    p = p + amount * by;
  }
}

void breathing(Random& random, const Draft&, Points& x, double amount) {
  breathe(random, mean(x), x, amount);
}

void jitter(Random& random, const Draft&, Points& x, double amount) {
  for (auto& p : x) p = p + 0.25 * amount * any_vector(random);
}

// Bends the z axis into an arc of up to a whole turn.
void bend(Random& random, const Draft&, Points& x, double amount) {
  const double half = reach(x, 2), turns = amount * (random.one_in(2) ? 0.5 : -0.5);
  const double radius = half / (2 * corpus::pi * turns);
  for (auto& p : x) {
    const double angle = turns * p[2] / half, r = radius - p[0];
    p = {radius - r * corpus::cos_turn(angle), p[1], r * corpus::sin_turn(angle)};
  }
}

void twist(Random& random, const Draft&, Points& x, double amount) {
  const auto axis = any_axis(random);
  const double turns = 0.5 * amount / reach(x, axis);
  for (auto& p : x) turn(p, axis, turns * p[axis]);
}

// Makes a waist, which goes through itself if the amount is large.
void pinch(Random& random, const Draft&, Points& x, double amount) {
  const auto axis = any_axis(random);
  const double half = reach(x, axis);
  for (auto& p : x) {
    const double h = p[axis] / half, width = 1 - 1.5 * amount * std::max(0.0, 1 - 2 * h * h);
    p[(axis + 1) % 3] *= width;
    if (amount > 0.5) p[(axis + 2) % 3] *= width;
  }
}

// Moves one half over to the other.
void fold(Random& random, const Draft&, Points& x, double amount) {
  const auto axis = any_axis(random);
  for (auto& p : x) {
    if (p[axis] > 0) p[axis] *= 1 - 2 * amount;
  }
}

// Collapses the mesh to a plane, a line or a point, exactly.
void collapse(Random& random, const Draft&, Points& x, double) {
  const auto first = any_axis(random);
  const int axes = random.between(1, 4) == 4 ? random.between(2, 3) : 1;
  for (int i = 0; i < axes; ++i) {
    for (auto& p : x) p[(first + at(i)) % 3] = 0;
  }
}

void flatten(Random& random, const Draft&, Points& x, double amount) {
  const auto axis = any_axis(random);
  const double height = 1 - amount * random.between(2, 5) / 4.0;
  for (auto& p : x) p[axis] *= height;
}

void jump(Random& random, const Draft&, Points& x, double amount) {
  Point& p = one_of(random, x);
  p = p + 2 * amount * any_vector(random);
}

// Moves a vertex, alone or with those beside it, through the middle of the mesh, or through a hole
// if there is one.
void poke(Random& random, const Draft& draft, Points& x, double amount) {
  const Point from = one_of(random, x);
  const Point goal = draft.holes.empty() ? -0.75 * from
                                         : 1.5 * draft.holes[static_cast<std::size_t>(random.below(
                                                     static_cast<int>(draft.holes.size())))];
  const Point by = amount * (goal - from);
  const double squared_reach = random.one_in(2) ? 0 : 0.25;
  for (auto& p : x) {
    if (dot(p - from, p - from) <= squared_reach) p = p + by;
  }
}

// Moves all vertices on one side of a plane together.
void part(Random& random, const Draft&, Points& x, double amount) {
  const Point normal = any_vector(random), by = amount * any_vector(random);
  for (auto& p : x) {
    if (dot(normal, p) > 0.25) p = p + by;
  }
}

// Moves the second piece towards the first, or anywhere.
void piece(Random& random, const Draft& draft, Points& x, double amount) {
  if (draft.second_piece == 0) return part(random, draft, x, amount);
  const auto second = static_cast<std::size_t>(draft.second_piece);
  const Point gap = x[0] - x[second];
  const Point by = amount * (random.one_in(3) ? any_vector(random) : gap);
  for (std::size_t v = second; v < x.size(); ++v) x[v] = x[v] + by;
}

void zero(Random&, const Draft&, Points&, double) {}

void fast(Random& random, const Draft&, Points& x, double) {
  for (auto& p : x) p = p + 8 * any_vector(random);
}

constexpr Motion motion_table[] = {
    {"rigid", rigid, 2, false, false},         {"affine", affine, 3, false, false},
    {"quadratic", quadratic, 3, false, false}, {"breathe", breathing, 2, false, false},
    {"jitter", jitter, 3, false, false},       {"bend", bend, 2, false, false},
    {"twist", twist, 2, false, false},         {"pinch", pinch, 2, false, false, true},
    {"fold", fold, 2, false, false, true},     {"flatten", flatten, 2, false, false, true},
    {"jump", jump, 5, false, false},           {"poke", poke, 4, false, false},
    {"part", part, 2, false, false},           {"piece", piece, 4, false, false},
    {"zero", zero, 1, false, false},           {"fast", fast, 1, false, true},
    {"collapse", collapse, 3, true, true},
};

}  // namespace

std::span<const Motion> motions() { return motion_table; }

std::vector<const Motion*> some_motions(Random& random, int count, bool exact_too,
                                        bool for_a_small_mesh) {
  const auto weight = [=](const Motion& m) {
    return (m.exact && !exact_too) || (m.small_meshes_only && !for_a_small_mesh) ? 0 : m.weight;
  };
  int total = 0;
  for (const auto& m : motion_table) total += weight(m);
  std::vector<const Motion*> motions;
  while (static_cast<int>(motions.size()) < count) {
    int place = random.below(total);
    for (const auto& m : motion_table) {
      place -= weight(m);
      if (place >= 0) continue;
      if (std::ranges::find(motions, &m) == motions.end()) motions.push_back(&m);
      break;
    }
  }
  return motions;
}

namespace {

// Returns the point of the view primitive in frame f that is nearest to c.
Point nearest_of_view(const Draft& draft, std::size_t f, const Point& c) {
  if (draft.q1.empty()) return draft.q0[f];
  const Point along = draft.q1[f] - draft.q0[f];
  const double s = dot(c - draft.q0[f], along) / dot(along, along);
  return between(draft.q0[f], draft.q1[f], std::clamp(s, 0.0, 1.0));
}

// Moves a vertex towards the view primitive by a factor of 2^-8 to 2^-12, along a ray. If the
// primitive is the mean of all vertices, the vertex pulls the mean along, which is taken into
// account.
void dent(Draft& draft, std::int32_t vertex, double share, std::size_t f) {
  Points& x = draft.frames[f];
  Point& c = at(x, vertex);
  if (!draft.q0.empty()) {
    c = between(nearest_of_view(draft, f, c), c, share);
  } else {
    const double part = (1 - share) / static_cast<double>(x.size());
    const Point others = static_cast<double>(x.size()) * mean(x) - c;
    c = (1 / (1 - part)) * (part * others + share * c);
  }
}

// Puts three vertices nearly into a plane with the view-point.
void turn_edge_on(const Face& f, double share, Points& x) {
  at(x, f[2]) = between(between(at(x, f[0]), at(x, f[1]), 0.5), at(x, f[2]), share);
}

// Puts the view just below a face, in all frames.
void view_from_below_surface(Random& random, Draft& draft) {
  const Face f = one_of(random, draft.faces);
  const double depth = std::ldexp(1, -random.between(8, 12));
  for (std::size_t k = 0; k < draft.frames.size(); ++k) {
    const Points& x = draft.frames[k];
    const Point on = between(between(at(x, f[0]), at(x, f[1]), 0.5), at(x, f[2]), 0.375);
    draft.q0[k] = between(on, draft.q0[k], depth);
  }
  draft.tag("close:below-surface");
}

}  // namespace

void move_positively(Random& random, Draft& draft, int steps) {
  draft.tag("motion:positive");
  const double amount = random.between(1, 12) / 16.0;
  const bool drifts = random.one_in(2);
  Points drift = {draft.holes.empty() ? Point{0, 0, 0} : mean(draft.rest())};
  for (int s = 0; s < steps; ++s) {
    Points x = draft.frames.back();
    breathe(random, drift.back(), x, amount / steps);
    const Point by = drifts ? any_vector(random) : Point{};
    for (auto& p : x) p = p + by;
    drift.push_back(drift.back() + by);
    draft.frames.push_back(std::move(x));
  }
  choose_inner_view(random, draft, drift);
  const int kind = random.below(8);
  if (kind == 0) return;
  if (kind == 1 && !draft.q0.empty() && draft.q1.empty()) {
    return view_from_below_surface(random, draft);
  }
  // The change is made in every second frame, so that each step has it at one of its ends.
  const Face face = one_of(random, draft.faces);
  const double share = std::ldexp(1, -random.between(8, 12));
  for (auto f = static_cast<std::size_t>(random.below(2)); f < draft.frames.size(); f += 2) {
    if (kind < 6) {
      dent(draft, face[2], share, f);
    } else {
      turn_edge_on(face, share, draft.frames[f]);
    }
  }
  draft.tag(kind < 6 ? "close:dent" : "close:edge-on");
}

}  // namespace assay::properties
