#include "detector/mesh/topology.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace assay::detector {
namespace {

// (row, item) lists to one array, items of a row in the order given.
template <class ForEachEntry>
Incidence make_incidence(std::size_t rows, ForEachEntry for_each_entry) {
  Incidence out;
  out.starts.assign(rows + 1, 0);
  for_each_entry([&](std::int32_t row, std::int32_t) { ++out.starts[at(row) + 1]; });
  std::partial_sum(out.starts.begin(), out.starts.end(), out.starts.begin());
  out.items.resize(at(out.starts.back()));
  std::vector<std::int32_t> next(out.starts.begin(), out.starts.end() - 1);
  for_each_entry(
      [&](std::int32_t row, std::int32_t item) { out.items[at(next[at(row)]++)] = item; });
  return out;
}

void make_edges(Topology& mesh) {
  struct Use {
    std::array<std::int32_t, 2> edge;
    std::int32_t triangle;
    int corner;
    auto operator<=>(const Use&) const = default;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto u = mesh.triangles[t][at((corner + 1) % 3)];
      const auto v = mesh.triangles[t][at((corner + 2) % 3)];
      uses.push_back({{std::min(u, v), std::max(u, v)}, static_cast<std::int32_t>(t), corner});
    }
  }
  std::sort(uses.begin(), uses.end());
  mesh.triangle_edges.resize(mesh.triangles.size());
  for (const Use& use : uses) {
    if (mesh.edges.empty() || mesh.edges.back() != use.edge) mesh.edges.push_back(use.edge);
    mesh.triangle_edges[at(use.triangle)][at(use.corner)] =
        static_cast<std::int32_t>(mesh.edges.size()) - 1;
  }
}

std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t v) {
  while (parent[at(v)] != v) {
    parent[at(v)] = parent[at(parent[at(v)])];
    v = parent[at(v)];
  }
  return v;
}

void make_components(Topology& mesh, std::size_t vertex_count) {
  std::vector<std::int32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& t : mesh.triangles) {
    for (int corner = 1; corner < 3; ++corner) {
      const auto a = root_of(parent, t[0]), b = root_of(parent, t[at(corner)]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  }
  // Components are numbered by lowest vertex; vertices of no triangle belong to none.
  std::vector<std::int32_t> number(vertex_count, -1);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (mesh.vertex_triangles.row(static_cast<std::int32_t>(v)).empty()) continue;
    const auto root = root_of(parent, static_cast<std::int32_t>(v));
    if (number[at(root)] < 0) {
      number[at(root)] = static_cast<std::int32_t>(mesh.components.size());
      mesh.components.emplace_back();
    }
    mesh.components[at(number[at(root)])].vertices.push_back(static_cast<std::int32_t>(v));
  }
  mesh.component_of_triangle.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = number[at(root_of(parent, mesh.triangles[t][0]))];
    mesh.component_of_triangle[t] = c;
    mesh.components[at(c)].triangles.push_back(static_cast<std::int32_t>(t));
  }
}

void find_cycles(Topology& mesh) {
  // Uses of an edge in ascending direction less uses in descending direction: 0 at every edge.
  std::vector<std::int32_t> surplus(mesh.edges.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto u = mesh.triangles[t][at((corner + 1) % 3)];
      const auto v = mesh.triangles[t][at((corner + 2) % 3)];
      surplus[at(mesh.triangle_edges[t][at(corner)])] += u < v ? 1 : -1;
    }
  }
  for (auto& component : mesh.components) component.is_cycle = true;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const auto e : mesh.triangle_edges[t]) {
      if (surplus[at(e)] != 0) mesh.components[at(mesh.component_of_triangle[t])].is_cycle = false;
    }
  }
}

}  // namespace

Topology make_topology(const TrianglesView& triangles, Eigen::Index vertex_count) {
  Topology mesh;
  mesh.triangles.resize(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    mesh.triangles[static_cast<std::size_t>(t)] = {triangles(t, 0), triangles(t, 1),
                                                   triangles(t, 2)};
  }
  make_edges(mesh);
  const auto for_each_of = [&mesh](const auto& lists, auto visit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const auto row : lists[t]) visit(row, static_cast<std::int32_t>(t));
    }
  };
  mesh.vertex_triangles = make_incidence(static_cast<std::size_t>(vertex_count),
                                         [&](auto visit) { for_each_of(mesh.triangles, visit); });
  mesh.edge_triangles = make_incidence(
      mesh.edges.size(), [&](auto visit) { for_each_of(mesh.triangle_edges, visit); });
  make_components(mesh, static_cast<std::size_t>(vertex_count));
  find_cycles(mesh);
  return mesh;
}

}  // namespace assay::detector
