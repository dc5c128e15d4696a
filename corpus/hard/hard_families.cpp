// Joins the families of all files of hard/, makes a case of a family and the grid meshes of cases,
// and holds view_families().
#include "corpus/hard/hard_families.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>

namespace assay::corpus {

std::span<const HardFamily> hard_families() {
  static const std::vector<HardFamily> all = [] {
    std::vector<HardFamily> rows;
    for (const auto& part : {feature_families(), time_families(), view_families(),
                             number_families(), crowd_families()}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  }();
  return all;
}

Case hard_case(const HardFamily& family, int strength, int variant) {
  Variation vary(family.name, strength, variant);
  const int kind = variant % family.kinds_at(strength);
  // Exact touching happens among features of every size.
  Case c =
      family.touches(strength)
          ? family.make(vary, family.exponent(static_cast<int>(vary.between(0, family.strongest))),
                        family.kinds + kind)
          : family.make(vary, family.exponent(strength), kind);
  c.id = fmt::format("{}-s{}-v{}", family.name, strength, variant);
  c.about = family.about;
  c.source = "corpus/hard";
  return c;
}

// View tests near zero: values that touch it, primitives on the surface, vertices beside the
// planes through the ends of a view-line. The sign of each triangle is an expected fact too.

namespace {

using detector::ViewSign;

constexpr ViewSign zero = ViewSign::zero, plus = ViewSign::positive, minus = ViewSign::negative;

KnownFacts with_signs(KnownFacts facts, std::vector<ViewSign> signs) {
  facts.view_signs = std::move(signs);
  return facts;
}

// Adds a tetrahedron on a wide face, its fourth corner on the axis. Its last triangle is the floor.
void add_tent(GridMesh& mesh, Variation& vary, const GridVertex& top, const GridPoint& moved) {
  const auto face = wide_face(vary, usual_size);
  const auto floor = [&](std::size_t i) { return GridVertex{face[i], face[i] + moved}; };
  mesh.add_tetrahedron({floor(0), floor(1), floor(2), top});
}

// Returns a tent. Even kinds: it moves up past the view-point at rest inside, until the view-point
// is above, below or on its floor. Odd kinds: the top comes down to above, below or on the floor,
// and the view-point is half as high all the time. If the top gets on or below the floor, all four
// triangles are in contact, and all their values are 0 at that time. That is t* = 1 if it stops on
// the floor, else t* = 1 - 2 gap / 2^45, because the top starts at 2^45 - 2 gap.
Case touches_zero(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  GridMesh mesh;
  KnownFacts facts;
  const std::int64_t ends[] = {gap, -gap, 0}, end = ends[kind / 2];
  const bool above = end > 0;
  if (kind % 2 == 0) {
    const GridPoint moved{0, 0, usual_size / 2 - end};
    const GridPoint top{0, 0, usual_size + vary.between(0, usual_size)};
    add_tent(mesh, vary, {top, top + moved}, moved);
    mesh.view = {at_rest({0, 0, usual_size / 2})};
    facts = with_signs(known_free(), {plus, plus, plus, above ? plus : zero});
  } else {
    const std::int64_t start = usual_size / 2 - gap;
    add_tent(mesh, vary, falling({}, 2 * start, 2 * end), {});
    mesh.view = {falling({}, start, end)};
    const ViewSign sign = above ? plus : zero;
    const double first = end == 0 ? 1 : 1 - std::ldexp(1, exponent + 1 - usual_exponent);
    facts = with_signs(above ? known_free() : known_collision(first), {sign, sign, sign, sign});
  }
  return sheared_case(mesh, vary, std::move(facts));
}

// Returns a tent that moves along with its view-point, which stays above, below or on the floor, or
// is one of its corners.
Case on_the_surface(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  GridMesh mesh;
  const GridPoint moved{vary.between(-usual_size, usual_size),
                        vary.between(-usual_size, usual_size),
                        vary.between(-usual_size, usual_size)};
  const GridPoint top{0, 0, vary.between(usual_size / 2, usual_size)};
  add_tent(mesh, vary, {top, top + moved}, moved);
  const std::int64_t heights[] = {gap, -gap, 0};
  constexpr ViewSign floor[] = {plus, minus, zero};
  if (kind < 3) {
    const GridPoint q{0, 0, heights[kind]};
    mesh.view = {{q, q + moved}};
    return sheared_case(mesh, vary, with_signs(known_free(), {plus, plus, plus, floor[kind]}));
  }
  mesh.view = {mesh.vertices[0]};
  return sheared_case(mesh, vary, with_signs(known_free(), {plus, zero, zero, zero}));
}

// Returns a triangle seen from a view-line on the x axis, from 0 to 2^45. It lies in the plane z =
// gap - x; its first corner comes to x = c near 0, and the others stay at x < 0. At x < 0 the
// nearest point is the line's end at 0 and the view value is gap (times twice the area seen along
// z); between the planes through the ends it is gap - x. So the triangle is positive exactly when c
// < gap. Kinds 3 to 5 are the same at the other end, mirrored, with the vertices exchanged to keep
// its side.
Case line_ends(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent), ends[] = {gap - 1, gap, gap + 1};
  const std::int64_t c = ends[kind % 3];
  const auto far = [&] { return vary.between(usual_size / 4, usual_size / 2); };
  const auto in_plane = [&](GridPoint p) {
    p.z = gap - p.x;
    return p;
  };
  const std::int64_t y = vary.between(-usual_size / 16, usual_size / 16);
  std::array<GridVertex, 3> corners = {
      GridVertex{in_plane({-vary.between(1, gap), y}), in_plane({c, y})},
      at_rest(in_plane({-far(), usual_size / 16 + far()})),
      at_rest(in_plane({-far(), -usual_size / 16 - far()}))};
  const bool mirrored = kind >= 3;
  if (mirrored) {
    for (auto& corner : corners) {
      corner.t0.x = usual_size - corner.t0.x;
      corner.t1.x = usual_size - corner.t1.x;
    }
    std::swap(corners[1], corners[2]);
  }
  GridMesh mesh;
  mesh.add_triangle(corners);
  mesh.view = {at_rest({0, 0, 0}), at_rest({usual_size, 0, 0})};
  return grid_case(mesh, GridMap::of_axes(vary), to_size_one,
                   with_signs(known_free(), {kind % 3 == 0 ? plus : zero}));
}

}  // namespace

std::vector<HardFamily> view_families() {
  return {{"view-touches-zero",
           "a tent rises until its floor is near its view-point, or its top falls near its floor",
           "height of the view-point over the floor", "ulp", 40, -1, 40, 4, 2, touches_zero},
          {"view-on-surface", "the view-point moves along with a face, above or below it",
           "distance from the face", "ulp", 40, -1, 40, 2, 2, on_the_surface},
          {"view-line-ends",
           "a vertex near the plane through a view-line's end; the view value is -1, 0 or 1 ulp",
           "distance from that plane", "ulp", 40, -1, 40, 6, 0, line_ends}};
}

namespace {

// Coordinates are below 2^53, so a volume is below 2^165.
using Wide = boost::multiprecision::int256_t;

// Returns six times the volume at t=0 of abcd.
Wide volume(const std::array<GridVertex, 4>& corners) {
  Wide e[3][3];
  const auto& o = corners[0].t0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& p = corners[i + 1].t0;
    e[i][0] = p.x - o.x;
    e[i][1] = p.y - o.y;
    e[i][2] = p.z - o.z;
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

// Returns units * 2^exponent. Ends the process if the product is not exact or not finite.
double scaled(std::int64_t units, int exponent) {
  constexpr std::int64_t limit = std::int64_t{1} << 53;
  const auto whole = static_cast<double>(units);
  const double x = std::ldexp(whole, exponent);
  if (std::abs(units) > limit || !std::isfinite(x) || std::ldexp(x, -exponent) != whole) {
    std::abort();
  }
  return x;
}

detector::Point place(const GridPoint& p, const GridMap& map, const std::array<int, 3>& exponents) {
  const GridPoint q = map(p);
  return {scaled(q.x, exponents[0]), scaled(q.y, exponents[1]), scaled(q.z, exponents[2])};
}

}  // namespace

std::int32_t GridMesh::add(const GridVertex& vertex) {
  vertices.push_back(vertex);
  return static_cast<std::int32_t>(vertices.size()) - 1;
}

void GridMesh::add_triangle(const std::array<GridVertex, 3>& corners) {
  const std::int32_t a = add(corners[0]), b = add(corners[1]), c = add(corners[2]);
  triangles.push_back({a, b, c});
}

void GridMesh::add_tetrahedron(const std::array<GridVertex, 4>& corners) {
  const auto first = static_cast<std::int32_t>(vertices.size());
  for (const auto& corner : corners) add(corner);
  // Face i lies opposite to corner i, and faces outward if the volume is positive.
  constexpr std::int32_t faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const bool turned = volume(corners) < 0;
  for (const auto& f : faces) {
    std::array<std::int32_t, 3> t = {first + f[0], first + f[1], first + f[2]};
    if (turned) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
}

GridMap GridMap::any(Variation& vary) {
  GridMap map = of_axes(vary);
  for (auto& shear : map.shears) {
    for (auto& coefficient : shear) {
      const auto sign = vary.sign();
      coefficient = sign * vary.between(1, 2);
    }
  }
  return map;
}

GridMap GridMap::of_axes(Variation& vary) {
  GridMap map;
  map.turns = static_cast<int>(vary.between(0, 2));
  return map;
}

GridPoint GridMap::operator()(GridPoint p) const {
  p.z += shears[0][0] * p.x + shears[0][1] * p.y;
  p.x += shears[1][0] * p.y + shears[1][1] * p.z;
  p.y += shears[2][0] * p.z + shears[2][1] * p.x;
  for (int i = 0; i < turns; ++i) p = {p.y, p.z, p.x};
  return p + shift;
}

Case grid_case(const GridMesh& mesh, const GridMap& map, const std::array<int, 3>& exponents,
               KnownFacts facts) {
  Case c;
  c.triangles.resize(static_cast<Eigen::Index>(mesh.triangles.size()), 3);
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      c.triangles(t, i) = mesh.triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(i)];
    }
  }
  const auto rows = static_cast<Eigen::Index>(mesh.vertices.size());
  c.frames.assign(2, detector::Positions(rows, 3));
  for (Eigen::Index v = 0; v < rows; ++v) {
    const auto& vertex = mesh.vertices[static_cast<std::size_t>(v)];
    const auto start = place(vertex.t0, map, exponents), end = place(vertex.t1, map, exponents);
    for (Eigen::Index i = 0; i < 3; ++i) {
      c.frames[0](v, i) = start[static_cast<std::size_t>(i)];
      c.frames[1](v, i) = end[static_cast<std::size_t>(i)];
    }
  }
  if (!mesh.view.empty()) {
    const auto path = [&](const GridVertex& q) {
      return std::vector<detector::Point>{place(q.t0, map, exponents), place(q.t1, map, exponents)};
    };
    c.view.emplace();
    c.view->q0 = path(mesh.view[0]);
    if (mesh.view.size() > 1) c.view->q1 = path(mesh.view[1]);
    c.options["culling"] = mesh.view.size() > 1 ? "view-line" : "view-point";
  }
  c.expected.answer = facts.answer;
  c.expected.steps.push_back(std::move(facts));
  return c;
}

Case sheared_case(const GridMesh& mesh, Variation& vary, KnownFacts facts) {
  return grid_case(mesh, GridMap::any(vary), to_size_one, std::move(facts));
}

// Corners (-a, -b), (c, -d), (e, f) with a, b, c, d, f in [3/4, 1] and |e| <= 1/8 of reach. How far
// the edges stay away from the origin:
// - The lower edge stays 3/4 below.
// - The left one passes y = 0 at x = -a + (e + a) b / (b + f) <= -3/4 + 7/8 * 4/7 = -1/4. Its slope
//   is at least (3/4 + 3/4) / (1 + 1/8) = 4/3, so it stays at least 1/4 * 4/5 = 1/5 away.
std::array<GridPoint, 3> wide_face(Variation& vary, std::int64_t reach) {
  const auto far = [&] { return vary.between(3 * reach / 4, reach); };
  const std::int64_t a = far(), b = far(), c = far(), d = far(), f = far();
  const std::int64_t e = vary.between(-reach / 8, reach / 8);
  return {GridPoint{-a, -b, 0}, GridPoint{c, -d, 0}, GridPoint{e, f, 0}};
}

void add_block(GridMesh& mesh, Variation& vary, std::int64_t reach, std::int64_t depth) {
  const auto face = wide_face(vary, reach);
  const GridPoint bottom = under_the_face(vary, reach, -depth);
  mesh.add_tetrahedron({at_rest(face[0]), at_rest(face[1]), at_rest(face[2]), at_rest(bottom)});
}

void add_spike(GridMesh& mesh, Variation& vary, const GridVertex& tip, std::int64_t reach,
               std::int64_t height, Side side) {
  const auto far = [&] { return vary.between(reach / 2, reach); };
  std::array<GridPoint, 3> top;
  switch (side) {
    case Side::all_around:
      top = {GridPoint{-far(), -far()}, GridPoint{far(), -far()}, GridPoint{0, far()}};
      break;
    case Side::positive_y:
      top = {GridPoint{-far(), far()}, GridPoint{far(), far()}, GridPoint{0, reach / 4}};
      break;
    case Side::negative_y:
      top = {GridPoint{-far(), -far()}, GridPoint{far(), -far()}, GridPoint{0, -reach / 4}};
      break;
  }
  for (auto& p : top) p.z = vary.between(height, 3 * height);
  mesh.add_tetrahedron({tip, carried(tip, top[0]), carried(tip, top[1]), carried(tip, top[2])});
}

GridPoint under_the_face(Variation& vary, std::int64_t reach, std::int64_t z) {
  const std::int64_t x = vary.between(-reach / 16, reach / 16);
  return {x, vary.between(-reach / 16, reach / 16), z};
}

GridVertex falling(const GridPoint& p, std::int64_t z_t0, std::int64_t z_t1) {
  return {{p.x, p.y, z_t0}, {p.x, p.y, z_t1}};
}

KnownFacts known_free() { return {}; }

KnownFacts known_collision(double first) {
  KnownFacts facts = known_collision();
  facts.first_time = {first, first};
  return facts;
}

KnownFacts known_collision() {
  KnownFacts facts;
  facts.answer = detector::Answer::collision;
  return facts;
}

}  // namespace assay::corpus
