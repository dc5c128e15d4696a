#include "properties/laws/facts/doubtful_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "properties/laws/facts/exact_view_values.h"

namespace assay::properties {

bool has_broken_edges(const CaseFacts& facts) {
  const auto& mesh = facts.surface().mesh;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto around = mesh.edge_triangles.row(static_cast<std::int32_t>(e));
    if (around.size() > 2) return true;
    if (around.size() < 2) continue;
    const auto runs_upward = [&](std::int32_t t) {
      const auto& v = mesh.triangles[at(t)];
      const auto i =
          static_cast<std::size_t>(std::find(v.begin(), v.end(), mesh.edges[e][0]) - v.begin());
      return v[(i + 1) % 3] == mesh.edges[e][1];
    };
    if (runs_upward(around[0]) == runs_upward(around[1])) return true;
  }
  return false;
}

bool has_coincident_vertices(const CaseFacts& facts, std::size_t s) {
  std::vector<detector::Point> places;
  for (const auto& component : facts.surface().mesh.components) {
    for (const auto v : component.vertices) places.push_back(detector::point_of(facts.x_t0(s), v));
  }
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

namespace {

// Whether the area vector, computed in doubles, is farther from 0 than its rounding errors. Each
// of two products has an error of 3 units of 2^-53 (two differences and one product), and their
// difference has 2 more. The bound is twice that, to cover errors of second order. The answer is
// false if the vector is nearer to 0, or if a product overflowed or vanished.
bool surely_has_area(const detector::Positions& x, const std::array<std::int32_t, 3>& v) {
  constexpr double error = 16 * 0x1p-53;
  const Eigen::RowVector3d a = x.row(v[1]) - x.row(v[0]), b = x.row(v[2]) - x.row(v[0]);
  const double product = a.cwiseAbs().maxCoeff() * b.cwiseAbs().maxCoeff();
  return product > 0x1p-900 && a.cross(b).cwiseAbs().maxCoeff() > error * product;
}

}  // namespace

bool has_zero_area(const CaseFacts& facts, std::size_t s, std::int32_t triangle) {
  const auto& v = facts.surface().mesh.triangles[at(triangle)];
  for (const auto* x : {&facts.x_t0(s), &facts.x_t1(s)}) {
    if (surely_has_area(*x, v)) continue;
    const auto corner = [&](std::size_t i) { return detector::SteppedMesh{*x, *x}.path(v[i]); };
    if (ExactView({corner(0), corner(1), corner(2)}, {}, 0).has_zero_area()) return true;
  }
  return false;
}

bool has_several_layers(CaseFacts& facts, std::size_t s) {
  const auto& layers = facts.layers_at_start(s);
  std::map<std::int32_t, oracle::Layer> of_component;
  for (std::size_t t = 0; t < layers.layer.size(); ++t) {
    if (!layers.layer[t]) continue;
    const auto entry = of_component.try_emplace(layers.component[t], *layers.layer[t]).first;
    if (entry->second != *layers.layer[t]) return true;
  }
  return false;
}

}  // namespace assay::properties
