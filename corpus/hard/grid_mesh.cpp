#include "corpus/hard/grid_mesh.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>

namespace assay::corpus {

namespace {

// Coordinates are below 2^53, so a volume is below 2^165.
using Wide = boost::multiprecision::int256_t;

// Six times the volume at t=0 of abcd.
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

// Ends the process if the product is not exact or not finite.
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
